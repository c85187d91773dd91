#include "pbf/render/raster/resolve.hpp"

#include "pbf/core/parallel.hpp"
#include "pbf/render/raster/composite_kernels.hpp"

#include <array>
#include <cmath>

namespace pbf::raster {
namespace {

std::array<float, 256> decoded_srgb() {
  std::array<float, 256> light{};
  for (int k = 0; k < 256; ++k) {
    const double c = k / 255.0;
    light[k] = static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
  }
  return light;
}

}  // namespace

const float* light_of_srgb() {
  static const std::array<float, 256> light = decoded_srgb();
  return light.data();
}

Picture picture_of(Image& image) {
  auto* top = reinterpret_cast<std::uint32_t*>(image.data.data());
  return {top + static_cast<std::ptrdiff_t>(image.width) * (image.height - 1), -image.width,
          image.width, image.height, light_of_srgb()};
}

void resolve(const Picture& picture, int factor, const Picture& out, int threads) {
  const CompositeKernels& kernels = composite_kernels(chosen_isa());
  parallel_chunks(out.height, threads, 8, [&](Index first, Index last) {
    for (Index y = first; y < last; ++y) {
      kernels.resolve(picture, factor, static_cast<int>(y), out);
    }
  });
}

}  // namespace pbf::raster
