// backdrop.frag: out: the picture without fluid, linear, multiplied by alpha.
layout(location = 0) out vec4 o_color;

void main() {
  vec4 light = seen(ray_origin(gl_FragCoord.xy), normalize(ray_direction(gl_FragCoord.xy)));
  o_color = display(light.rgb, light.a);
}
