#include "pbf/render/legend.hpp"

#include "pbf/render/lettering.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace pbf {
namespace {

constexpr std::uint32_t kInk = 0x1E242B;
constexpr std::uint32_t kPaper = 0xFFFFFF;
constexpr double kPaperShare = 0.78;

/// Without a minus before zero, and with the sign that is as long as a plus.
std::string number(double value, int decimals) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, std::abs(value));
  const bool is_zero =
      std::string_view(text.data()).find_first_of("123456789") == std::string::npos;
  return (value < 0 && !is_zero ? "\u2212" : "") + std::string(text.data());
}

std::string superscript(int value) {
  constexpr std::array digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = value < 0 ? "⁻" : "";
  for (const char digit : std::to_string(std::abs(value))) {
    text += digits[static_cast<std::size_t>(digit - '0')];
  }
  return text;
}

void fill(
    Image& image, double x0, double y0, double x1, double y1, std::uint32_t color, double share) {
  const auto cover = [](double low, double high, int pixel) {
    return std::clamp(std::min(high, pixel + 1.0) - std::max(low, double(pixel)), 0.0, 1.0);
  };
  for (int y = static_cast<int>(std::floor(y0)); y < y1; ++y) {
    for (int x = static_cast<int>(std::floor(x0)); x < x1; ++x) {
      blend(image, x, y, color, share * cover(x0, x1, x) * cover(y0, y1, y));
    }
  }
}

}  // namespace

Ticks ticks_of(const ColorRange& range) {
  const double low = static_cast<double>(range[0]);
  const double high = static_cast<double>(range[1]);
  const double least_step = (high - low) / 6;
  double step = std::pow(10.0, std::floor(std::log10(least_step)));
  for (const double factor : {2.0, 2.5, 2.0}) {  // 1, 2, 5, 10
    if (step >= least_step * (1 - 1e-9)) break;
    step *= factor;
  }
  Ticks result;
  const double largest = std::max(std::abs(low), std::abs(high));
  const int magnitude = static_cast<int>(std::floor(std::log10(largest) + 1e-9));
  if (magnitude >= 5 || step < 0.9e-3) result.exponent = magnitude;
  const double unit = std::pow(10.0, result.exponent);
  const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step / unit) + 1e-9)));
  const double slack = 1e-6;  // of a step: the ends are float32
  for (double k = std::ceil(low / step - slack); k <= high / step + slack; ++k) {
    result.ticks.push_back({k * step, number(k * step / unit, decimals)});
  }
  return result;
}

void draw_legend(Image& image, const std::string& label, Colormap map, const ColorRange& range) {
  const double size = std::max(6.0, image.height / 65.0);
  const Ticks ticks = ticks_of(range);
  const std::string factor = ticks.exponent == 0 ? "" : "\u00D7 10" + superscript(ticks.exponent);
  const double bar_width = 1.5 * size;
  const double bar_height = 16 * size;
  const double tick_length = 0.45 * size;
  const double gap = 0.5 * size;
  const double pad = 1.1 * size;
  double numbers = width_of(factor, size);
  for (const auto& tick : ticks.ticks) numbers = std::max(numbers, width_of(tick.text, size));
  const double inner = std::max(width_of(label, size), bar_width + tick_length + gap + numbers);
  const double head = (factor.empty() ? 1 : 2.7) * size;
  const double left = std::round(image.width - 1.5 * size - 2 * pad - inner);
  const double top = std::round(1.5 * size);
  fill(image, left, top, left + inner + 2 * pad, top + 2 * pad + head + 1.4 * size + bar_height,
       kPaper, kPaperShare);
  draw_text(image, label, left + pad, top + pad + size, size, kInk);
  if (!factor.empty()) {
    draw_text(image, factor, left + pad + bar_width + tick_length + gap, top + pad + 2.7 * size,
              size, kInk);
  }
  const double x = std::round(left + pad);
  const double y = std::round(top + pad + head + 1.4 * size);
  const double line = std::max(1.0, std::round(size / 9));
  fill(image, x - line, y - line, x + bar_width + line, y + bar_height + line, kInk, 1);
  const auto& table = table_of(map);
  for (int row = 0; row < static_cast<int>(bar_height); ++row) {
    const double share = 1 - (row + 0.5) / std::floor(bar_height);
    const auto color = table[static_cast<std::size_t>(share * kColormapSize)];
    fill(image, x, y + row, x + bar_width, y + row + 1, color, 1);
  }
  for (const auto& [value, text] : ticks.ticks) {
    const double low = static_cast<double>(range[0]);
    const double share =
        std::clamp((value - low) / (static_cast<double>(range[1]) - low), 0.0, 1.0);
    const double at = y + (1 - share) * bar_height;
    const double edge = x + bar_width;
    fill(image, edge, at - line / 2, edge + tick_length, at + line / 2, kInk, 1);
    draw_text(image, text, edge + tick_length + gap, at + size / 2, size, kInk);
  }
}

}  // namespace pbf
