#pragma once

#include "pbf/core/fields.hpp"
#include "pbf/render/colormap.hpp"

#include <optional>

namespace pbf {

/// What the particles are drawn as.
enum class Style { fluid, spheres };
template <>
struct Choices<Style> {
  static constexpr std::array names{"fluid", "spheres"};
};

/// How depth is smoothed.
enum class Smoothing { bilateral, gaussian, narrow_range, curvature_flow };
template <>
struct Choices<Smoothing> {
  static constexpr std::array names{"bilateral", "gaussian", "narrow_range", "curvature_flow"};
};

/// How thickness is smoothed.
enum class ThicknessSmoothing { bilateral, gaussian };
template <>
struct Choices<ThicknessSmoothing> {
  static constexpr std::array names{"bilateral", "gaussian"};
};

/// What stands behind and around the fluid.
enum class Background { sky, plain, map, transparent };
template <>
struct Choices<Background> {
  static constexpr std::array names{"sky", "plain", "map", "transparent"};
};

/// What the fluid's surface mirrors, beside the floor.
enum class Reflection { sky, plain, map };
template <>
struct Choices<Reflection> {
  static constexpr std::array names{"sky", "plain", "map"};
};

/// How light that is too bright for a screen is brought back.
enum class ToneMapping { soft, none, aces };
template <>
struct Choices<ToneMapping> {
  static constexpr std::array names{"soft", "none", "aces"};
};

/// How the fluid is drawn. SI units; colors are linear, 0 to 1.
struct RenderParams {
  Style style = Style::fluid;
  Real radius = 0.02F;
  std::optional<Real> drop_radius = std::nullopt;
  std::optional<Real> particle_volume = std::nullopt;
  Real anisotropy = 0.0F;
  Smoothing smoothing = Smoothing::bilateral;
  std::optional<Real> smoothing_radius = std::nullopt;
  std::optional<Real> smoothing_range = std::nullopt;
  int smoothing_iterations = 2;
  ThicknessSmoothing thickness_smoothing = ThicknessSmoothing::gaussian;
  std::optional<Real> thickness_radius = std::nullopt;
  std::optional<Real> thickness_range = std::nullopt;
  int thickness_iterations = 1;
  Vec3 absorption{7.0F, 2.0F, 1.0F};
  Vec3 scatter{0.015F, 0.12F, 0.19F};
  Real refractive_index = 1.333F;
  std::optional<Real> sphere_radius = std::nullopt;
  Vec3 sphere_color{0.10F, 0.32F, 0.60F};
  Colormap colormap = Colormap::viridis;
  std::optional<ColorRange> color_range = std::nullopt;
  std::string legend{};
  std::optional<Real> tint_depth = std::nullopt;
  Background background = Background::sky;
  std::optional<Reflection> reflection = std::nullopt;
  Vec3 background_color{1.0F, 1.0F, 1.0F};
  Vec3 sun_direction{-0.45F, 0.8F, 0.35F};
  Real shadow = 0.6F;
  Vec3 up{0.0F, 1.0F, 0.0F};
  bool floor = true;
  std::optional<Real> floor_height = std::nullopt;
  std::optional<Vec3> tank_lower = std::nullopt;
  std::optional<Vec3> tank_upper = std::nullopt;
  Real exposure = 1.0F;
  ToneMapping tone_mapping = ToneMapping::soft;
  int supersampling = 1;

  // What the optional fields stand for when not given.
  [[nodiscard]] Real drop_radius_in_force() const { return drop_radius.value_or(radius); }
  /// How far from a particle others have a say in its sprite's size and shape: 2.4 particle
  /// distances [m], or 0 if all sprites are alike.
  [[nodiscard]] Real neighbor_distance() const;
  [[nodiscard]] Real volume_in_force() const;  ///< [m³]
  [[nodiscard]] Real sphere_radius_in_force() const { return sphere_radius.value_or(radius / 2); }
  [[nodiscard]] Vec3 tint_absorption() const {
    return Vec3::Constant(1 / tint_depth.value_or(radius));
  }
  [[nodiscard]] Real smoothing_radius_in_force() const {
    return smoothing_radius.value_or(2.0F * radius);
  }
  [[nodiscard]] Real smoothing_range_in_force() const {
    return smoothing_range.value_or(4.0F * radius);
  }
  [[nodiscard]] Real thickness_radius_in_force() const {
    return thickness_radius.value_or(2.0F * radius);
  }
  [[nodiscard]] Real thickness_range_in_force() const {
    return thickness_range.value_or(4.0F * radius);
  }

  [[nodiscard]] Reflection reflection_in_force() const {
    return reflection.value_or(background == Background::plain ? Reflection::plain
                               : background == Background::map ? Reflection::map
                                                               : Reflection::sky);
  }
  /// Whether an environment map is seen or mirrored.
  [[nodiscard]] bool shows_map() const {
    return background == Background::map || reflection_in_force() == Reflection::map;
  }

  static constexpr const char* kName = "RenderParams";
  static auto fields() {
    using P = RenderParams;
    return std::tuple{
        Field{
            "style", &P::style, "", anything(),
            "fluid: a liquid with a smooth surface. spheres: the particles themselves, opaque, for "
            "who wants to see what the solver does."},
        Field{"radius", &P::radius, "m", inside(1e-7, 1e6),
              "Radius of a particle's sprite. Sprites must overlap: the particle distance is a "
              "good value."},
        Field{
            "drop_radius", &P::drop_radius, "m", inside(1e-7, 1e6),
            "Radius of the sprite of a particle that is alone; at most radius, which it is if not "
            "given. With 0.62 times the particle distance a drop has its particle's volume. Small "
            "groups of particles lie between, told by what is within 2.4 particle distances: cube "
            "roots of particle_volume, without it radii. The depth filter leaves drops round."},
        Field{"particle_volume", &P::particle_volume, "m^3", inside(0, 1e18),
              "Volume that a particle adds to the thickness, the sprite's own if not given. With "
              "the cube of "
              "the particle distance, thickness is the length of the path through the fluid."},
        Field{"anisotropy", &P::anisotropy, "", between(0, 1),
              "How far sprites follow the fluid around them. 0: spheres. 1: ellipsoids, flat along "
              "the surface and long in a jet, up to four times as long as thick: edges without "
              "beads, thinner sheets, and a surface that lies half a particle distance deeper, for "
              "more time. Drops stay round."},
        Field{"smoothing", &P::smoothing, "", anything(),
              "How depth is smoothed. bilateral keeps steps of depth that are higher than "
              "smoothing_range, so that a drop stays in front of what is behind it; narrow_range "
              "also smooths across steep surfaces and rounds off the edge of what is in front; "
              "curvature_flow moves the surface by its curvature, at many times the cost; gaussian "
              "melts what is in front and behind together."},
        Field{"smoothing_radius", &P::smoothing_radius, "m", inside(0, 1e6),
              "Where the depth filter's kernel ends, 2 * radius if not given; its standard "
              "deviation is half of that. Larger is smoother and rounder."},
        Field{"smoothing_range", &P::smoothing_range, "m", inside(0, 1e6),
              "Steps of depth higher than this are kept, by all but the gaussian filter; 4 * "
              "radius if not given."},
        Field{"smoothing_iterations", &P::smoothing_iterations, "", between(0, 16),
              "How often the depth filter runs. More is smoother and slower."},
        Field{"thickness_smoothing", &P::thickness_smoothing, "", anything(),
              "How thickness is smoothed: gaussian, or bilateral, which keeps steps higher than "
              "thickness_range."},
        Field{"thickness_radius", &P::thickness_radius, "m", inside(0, 1e6),
              "As smoothing_radius, for the thickness; 2 * radius if not given."},
        Field{"thickness_range", &P::thickness_range, "m", inside(0, 1e6),
              "As smoothing_range, for the thickness."},
        Field{"thickness_iterations", &P::thickness_iterations, "", between(0, 16),
              "How often the thickness filter runs."},
        Field{"absorption", &P::absorption, "1/m", between(0, 1e6),
              "Share of red, green and blue light lost per meter (Beer-Lambert). Larger is darker "
              "and more "
              "colorful."},
        Field{"scatter", &P::scatter, "", between(0, 1),
              "Color that deep fluid glows with instead of turning black."},
        Field{"refractive_index", &P::refractive_index, "", between(1, 4),
              "1.333 for water. Bends what is seen through the fluid and makes its surface a "
              "mirror."},
        Field{"sphere_radius", &P::sphere_radius, "m", inside(1e-7, 1e6),
              "Radius of a particle drawn as a sphere, radius / 2 if not given: spheres half the "
              "particle distance large touch one another."},
        Field{"sphere_color", &P::sphere_color, "", between(0, 1),
              "Color of spheres that are drawn without values."},
        Field{"colormap", &P::colormap, "", anything(),
              "Which color a value gets. viridis, magma, cividis and gray rise in lightness, "
              "cividis looks nearly the same to color-blind eyes; coolwarm has a middle; shuffled "
              "gives whole numbers, such as ids, colors that tell neighbors apart."},
        Field{
            "color_range", &P::color_range, "", between(-1e30, 1e30),
            "Values of the first and the last color; what is beyond gets the color of that end. "
            "The least and the greatest of the picture's values if not given, so the pictures of a "
            "video need a range to be comparable. Not used by shuffled."},
        Field{
            "legend", &P::legend, "", anything(),
            "What the values are, with unit, such as \"speed [m/s]\": drawn with a color bar into "
            "the picture's corner where values are given. No legend if empty."},
        Field{
            "tint_depth", &P::tint_depth, "m", inside(0, 1e6),
            "How deep fluid colored by values must be to hide 63 % of what is behind it, in place "
            "of absorption; radius if not given, which is opaque but for spray. Larger is glass."},
        Field{"background", &P::background, "", anything(),
              "sky: a bright sky with a sun. plain: background_color everywhere. map: the "
              "renderer's environment map. transparent: "
              "nothing; the "
              "picture's alpha says how much of another background comes through floor and fluid."},
        Field{"reflection", &P::reflection, "", anything(),
              "What the surface mirrors beside the floor: sky, with studio lights, or plain, "
              "background_color everywhere, or map, the renderer's environment map. If not "
              "given, the background's own, and sky over transparency."},
        Field{"background_color", &P::background_color, "", between(0, 1),
              "Color of the plain background. A transparent picture is exact over it; over others "
              "fluid that absorbs colors unequally loses a little of its tint."},
        Field{"sun_direction", &P::sun_direction, "", between(-1e6, 1e6),
              "Towards the sun. Any length but zero."},
        Field{"shadow", &P::shadow, "", between(0, 1),
              "How much of the floor's light comes from the sun, and is absorbed in the fluid's "
              "shadow. 0: no "
              "shadow. 1: black where no light comes through."},
        Field{
            "up", &P::up, "", between(-1e6, 1e6),
            "Up in the scene: the floor lies across it, the zenith is there. Any length but zero."},
        Field{"floor", &P::floor, "", anything(), "Whether a floor is drawn."},
        Field{"floor_height", &P::floor_height, "m", between(-1e9, 1e9),
              "Where the floor lies along up; the bottom of the tank if not given, without a tank "
              "0."},
        Field{"tank_lower", &P::tank_lower, "m", between(-1e9, 1e9),
              "A corner of the tank whose edges are drawn; none if not given."},
        Field{"tank_upper", &P::tank_upper, "m", between(-1e9, 1e9), "The opposite corner."},
        Field{"exposure", &P::exposure, "", inside(0, 1e6), "Brightness of the picture."},
        Field{"tone_mapping", &P::tone_mapping, "", anything(),
              "How bright light is brought into the picture. soft: values below 0.8 stay as they "
              "are. none: "
              "values above 1 are cut off. aces: the contrast of film, darker and more colorful."},
        Field{"supersampling", &P::supersampling, "", between(1, 4),
              "The picture is drawn this many times wider and higher, and averaged in linear "
              "light: smoother "
              "edges, and as many times squared slower. Layers are not."},
    };
  }
  void check_together(Faults& faults) const;
};

}  // namespace pbf
