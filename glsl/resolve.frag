// resolve.frag: in: the picture, larger by a whole factor, colors multiplied by alpha. Out: the
// mean of its pixels in linear light, colors divided by alpha.
uniform sampler2D u_color;
uniform int u_factor;
layout(location = 0) out vec4 o_color;

void main() {
  ivec2 first = u_factor * ivec2(gl_FragCoord.xy);
  vec4 sum = vec4(0.0);
  for (int y = 0; y < u_factor; ++y) {
    for (int x = 0; x < u_factor; ++x) sum += texelFetch(u_color, first + ivec2(x, y), 0);
  }
  vec4 mean = sum / float(u_factor * u_factor);
  o_color = vec4(mean.rgb / max(mean.a, 1e-6), mean.a);
}
