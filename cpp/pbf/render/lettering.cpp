#include "pbf/render/lettering.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace pbf {
namespace {

/// Strokes on a grid on which y = 2 is the baseline, 7 the height of x and 9 that of X: points "xy"
/// joined by lines, whose corners are rounded; a space begins the next stroke.
struct Glyph {
  char32_t code;
  int width;
  const char* strokes;
};

constexpr Glyph kGlyphs[] = {
    {U'0', 4, "220209494222"},
    {U'1', 4, "0729 2922"},
    {U'2', 4, "0709494602 0242"},
    {U'3', 4, "0709494616 1646420204"},
    {U'4', 4, "3904 0444 3632"},
    {U'5', 4, "4909 0906 0646420203"},
    {U'6', 4, "48490902424606"},
    {U'7', 4, "0949 4912"},
    {U'8', 4, "260609494626 260602424626"},
    {U'9', 4, "03024249090545"},
    {U'A', 4, "0229 2942 1434"},
    {U'B', 4, "0209 09494606 06464202"},
    {U'C', 4, "474909024244"},
    {U'D', 4, "0209 09494202"},
    {U'E', 4, "4909 0902 0242 0636"},
    {U'F', 4, "4909 0902 0636"},
    {U'G', 4, "474909024245 4525"},
    {U'H', 4, "0902 4942 0646"},
    {U'I', 0, "0902"},
    {U'J', 3, "39320204"},
    {U'K', 4, "0902 4905 1642"},
    {U'L', 3, "0902 0232"},
    {U'M', 4, "0209 0925 2549 4942"},
    {U'N', 4, "0209 0942 4249"},
    {U'O', 5, "320209595232"},
    {U'P', 4, "0209 09494505"},
    {U'Q', 5, "320209595232 3451"},
    {U'R', 4, "0209 09494505 2542"},
    {U'S', 4, "4849090646420203"},
    {U'T', 4, "0949 2922"},
    {U'U', 4, "09024249"},
    {U'V', 4, "0922 2249"},
    {U'W', 6, "0912 1237 3752 5269"},
    {U'X', 4, "0942 0249"},
    {U'Y', 4, "0925 2549 2522"},
    {U'Z', 4, "0949 4902 0242"},
    {U'a', 4, "464707024243 4742"},
    {U'b', 4, "0902 030242470706"},
    {U'c', 4, "464707024243"},
    {U'd', 4, "4942 464707024243"},
    {U'e', 4, "0545 454707024243"},
    {U'f', 3, "391912 0727"},
    {U'g', 4, "464707024243 474000"},
    {U'h', 4, "0902 05074742"},
    {U'i', 0, "0702 0909"},
    {U'j', 1, "171000 1919"},
    {U'k', 4, "0902 4704 2542"},
    {U'l', 1, "090212"},
    {U'm', 6, "0207 05073732 35376762"},
    {U'n', 4, "0207 05074742"},
    {U'o', 4, "220207474222"},
    {U'p', 4, "0700 030242470706"},
    {U'q', 4, "4740 464707024243"},
    {U'r', 3, "0207 050737"},
    {U's', 4, "4647070544420203"},
    {U't', 3, "191232 0727"},
    {U'u', 4, "07024245 4742"},
    {U'v', 4, "0722 2247"},
    {U'w', 6, "0712 1236 3652 5267"},
    {U'x', 4, "0742 0247"},
    {U'y', 4, "0722 4710"},
    {U'z', 4, "0747 4702 0242"},
    {U' ', 2, ""},
    {U'.', 0, "0202"},
    {U',', 1, "1200"},
    {U':', 0, "0202 0606"},
    {U';', 1, "1200 1616"},
    {U'!', 0, "0905 0202"},
    {U'?', 4, "0809494525 2524 2222"},
    {U'\'', 0, "0907"},
    {U'"', 2, "0907 2927"},
    {U'-', 3, "0535"},
    {U'\u2212', 4, "0545"},  // minus
    {U'\u2013', 4, "0545"},  // dash
    {U'+', 4, "0545 2723"},
    {U'=', 4, "0444 0646"},
    {U'<', 4, "4705 0543"},
    {U'>', 4, "0745 4503"},
    {U'/', 3, "0139"},
    {U'|', 0, "0901"},
    {U'(', 1, "190511"},
    {U')', 1, "091501"},
    {U'[', 1, "1909 0901 0111"},
    {U']', 1, "0919 1911 1101"},
    {U'_', 4, "0141"},
    {U'*', 4, "2723 0644 4604"},
    {U'%', 6, "190907272919 523234545252 1259"},
    {U'\u00B7', 0, "0505"},          // middle dot
    {U'\u00D7', 4, "0743 0347"},     // times
    {U'\u00B0', 2, "190907272919"},  // degree
    {U'\u00B5', 4, "0700 03024245 4742"},
    {U'\u03BC', 4, "0700 03024245 4742"},  // mu
    {U'\u03C1', 4, "000747420203"},        // rho
    {U'\u03C9', 6, "07023235 35326267"},   // omega
};
constexpr Glyph kBox{0, 4, "0209 0949 4942 4202"};
constexpr int kBaseline = 2;
constexpr double kCapital = 7;     // height of a capital on the grid
constexpr double kStroke = 1.0;    // width of a stroke
constexpr double kGap = 2.0;       // between two letters, from stroke to stroke
constexpr double kRounding = 2.0;  // of corners
constexpr double kSuperscript = 0.62;

struct Point {
  double x, y;
};
Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }
Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
Point operator*(double s, Point a) { return {s * a.x, s * a.y}; }
double length(Point a) { return std::hypot(a.x, a.y); }

/// The digit or sign that a superscript is a small one of; 0 for other letters.
char32_t raised(char32_t code) {
  switch (code) {
    case U'\u00B9':
      return U'1';
    case U'\u00B2':
      return U'2';
    case U'\u00B3':
      return U'3';
    case U'\u207B':
      return U'\u2212';
    default:
      return code == U'\u2070' || (code >= U'\u2074' && code <= U'\u2079') ? code - U'\u2070' + U'0'
                                                                           : 0;
  }
}

const Glyph& glyph_of(char32_t code) {
  const auto* found = std::find_if(std::begin(kGlyphs), std::end(kGlyphs),
                                   [&](const Glyph& glyph) { return glyph.code == code; });
  return found == std::end(kGlyphs) ? kBox : *found;
}

/// Of broken UTF-8 each byte that fits nowhere is a letter of its own, which has no glyph.
std::vector<char32_t> decoded(std::string_view text) {
  std::vector<char32_t> codes;
  for (std::size_t k = 0; k < text.size();) {
    const auto lead = static_cast<unsigned char>(text[k]);
    const int more = lead < 0xC0 ? 0 : lead < 0xE0 ? 1 : lead < 0xF0 ? 2 : 3;
    char32_t code = more == 0 ? lead : lead & (0x3FU >> more);
    ++k;
    for (int j = 0; j < more && k < text.size(); ++j, ++k) {
      code = code << 6 | (static_cast<unsigned char>(text[k]) & 0x3FU);
    }
    codes.push_back(code);
  }
  return codes;
}

/// Calls f(glyph, left end, scale, rise), all but the glyph in units of the grid, for each letter;
/// returns where the last one ends.
double lay_out(std::string_view text,
               const std::function<void(const Glyph&, double, double, double)>& f) {
  double x = 0;
  double end = 0;
  for (const char32_t code : decoded(text)) {
    const char32_t small = raised(code);
    const double scale = small != 0 ? kSuperscript : 1;
    const Glyph& glyph = glyph_of(small != 0 ? small : code);
    const double rise = small != 0 ? kCapital * (1.08 - kSuperscript) : 0;
    f(glyph, x, scale, rise);
    end = x + scale * glyph.width;
    x = end + kGap * scale;
  }
  return end;
}

using Line = std::vector<Point>;

/// Cuts the corners off and puts parabolas in their place.
Line rounded(const Line& line) {
  Line result{line.front()};
  for (std::size_t k = 1; k + 1 < line.size(); ++k) {
    const Point before = line[k - 1] - line[k];
    const Point after = line[k + 1] - line[k];
    // Half of a side that another corner needs as well, all of the first and the last.
    const double left = length(before) * (k == 1 ? 1.0 : 0.5);
    const double right = length(after) * (k + 2 == line.size() ? 1.0 : 0.5);
    const double cut = std::min({kRounding, left, right});
    const Point a = line[k] + (cut / length(before)) * before;
    const Point b = line[k] + (cut / length(after)) * after;
    constexpr int kParts = 6;
    for (int i = 0; i <= kParts; ++i) {
      const double t = static_cast<double>(i) / kParts;
      result.push_back((1 - t) * (1 - t) * a + 2 * t * (1 - t) * line[k] + t * t * b);
    }
  }
  result.push_back(line.back());
  return result;
}

std::vector<Line> lines_of(const Glyph& glyph) {
  std::vector<Line> lines(1);
  const std::string_view strokes = glyph.strokes;
  for (std::size_t k = 0; k + 1 < strokes.size();) {
    if (strokes[k] == ' ') {
      lines.emplace_back();
      ++k;
      continue;
    }
    lines.back().push_back({static_cast<double>(strokes[k] - '0'),
                            static_cast<double>(strokes[k + 1] - '0' - kBaseline)});
    k += 2;
  }
  if (lines.front().empty()) lines.clear();
  for (Line& line : lines) line = rounded(line);
  return lines;
}

double distance(Point p, Point a, Point b) {
  const Point along = b - a;
  const double length2 = along.x * along.x + along.y * along.y;
  const Point from = p - a;
  const double t =
      length2 > 0 ? std::clamp((from.x * along.x + from.y * along.y) / length2, 0.0, 1.0) : 0.0;
  return length(from - t * along);
}

/// @param line  in pixels
void draw_line(Image& image, const std::vector<Line>& lines, double width, std::uint32_t color) {
  Point low{1e9, 1e9};
  Point high{-1e9, -1e9};
  for (const Line& line : lines) {
    for (const Point& p : line) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
  }
  const double margin = width / 2 + 1;
  for (int y = static_cast<int>(low.y - margin); y <= high.y + margin; ++y) {
    for (int x = static_cast<int>(low.x - margin); x <= high.x + margin; ++x) {
      double nearest = 1e9;
      for (const Line& line : lines) {
        for (std::size_t k = 0; k + 1 < line.size(); ++k) {
          nearest = std::min(nearest, distance({x + 0.5, y + 0.5}, line[k], line[k + 1]));
        }
      }
      blend(image, x, y, color, std::clamp(width / 2 - nearest + 0.5, 0.0, 1.0));
    }
  }
}

}  // namespace

void blend(Image& image, int x, int y, std::uint32_t color, double share) {
  if (share <= 0 || x < 0 || y < 0 || x >= image.width || y >= image.height) return;
  std::uint8_t* pixel =
      image.data.data() + (static_cast<std::size_t>(y) * image.width + x) * image.channels;
  const auto mix = [&](std::uint8_t& value, double with) {
    value = static_cast<std::uint8_t>(std::lround((1 - share) * value + share * with));
  };
  for (int k = 0; k < 3; ++k) mix(pixel[k], color >> (16 - 8 * k) & 0xFF);
  mix(pixel[3], 255);
}

double width_of(std::string_view text, double size) {
  return size / kCapital * lay_out(text, [](const Glyph&, double, double, double) {});
}

void draw_text(
    Image& image, std::string_view text, double x, double y, double size, std::uint32_t color) {
  const double unit = size / kCapital;
  lay_out(text, [&](const Glyph& glyph, double left, double scale, double rise) {
    std::vector<Line> lines = lines_of(glyph);
    for (Line& line : lines) {
      for (Point& p : line) {
        p = {x + unit * (left + scale * p.x), y - unit * (rise + scale * p.y)};
      }
    }
    // Small letters keep more of their strokes' width: thin ones fade.
    if (!lines.empty()) draw_line(image, lines, unit * kStroke * std::sqrt(scale), color);
  });
}

}  // namespace pbf
