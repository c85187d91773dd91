#include "pbf/render/frame_block.hpp"

namespace pbf {

FrameBlock frame_block(const Camera& camera, int width, int height) {
  FrameBlock block{};
  Eigen::Map<Eigen::Matrix4f>(block.view.data()) = camera.view();
  const float half_height = camera.half_height();
  const auto w = static_cast<float>(width);
  const auto h = static_cast<float>(height);
  block.lens = {half_height * w / h, half_height, camera.near, camera.far};
  block.size = {w, h, camera.orthographic ? 0.0F : 1.0F, h / (2.0F * half_height)};
  return block;
}

}  // namespace pbf
