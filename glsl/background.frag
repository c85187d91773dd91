// background.frag: out: the picture without fluid, sRGB-encoded, opaque.
layout(location = 0) out vec4 o_color;

void main() {
  vec3 direction = ray_direction(gl_FragCoord.xy);
  o_color = display(seen(ray_origin(gl_FragCoord.xy), normalize(direction)));
}
