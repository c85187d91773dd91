# The renderer: EGL and OpenGL are opened at run time, so nothing but the loader is linked.
include(${PROJECT_SOURCE_DIR}/cmake/pbf_embed_glsl.cmake)

add_library(pbf_render STATIC
  pbf/gl/functions.cpp
  pbf/gl/egl_turn.cpp
  pbf/gl/egl_device.cpp
  pbf/gl/egl_display.cpp
  pbf/gl/egl_cures.cpp
  pbf/gl/software_threads.cpp
  pbf/gl/egl_context.cpp
  pbf/gl/buffer.cpp
  pbf/gl/texture.cpp
  pbf/gl/framebuffer.cpp
  pbf/gl/program.cpp
  pbf/gl/draw.cpp
  pbf/gl/error.cpp
  pbf/render/camera.cpp
  pbf/render/checks.cpp
  pbf/render/cpu_renderer.cpp
  pbf/render/environment.cpp
  pbf/render/shadow_rectangle.cpp
  pbf/render/params.cpp
  pbf/render/colormap.cpp
  pbf/render/lettering.cpp
  pbf/render/legend.cpp
  pbf/render/extent.cpp
  pbf/render/deposit.cpp
  pbf/render/full_cells.cpp
  pbf/render/crowding.cpp
  pbf/render/neighborhoods.cpp
  pbf/render/anisotropy.cpp
  pbf/render/layer_filter.cpp
  pbf/render/sun_shadow.cpp
  pbf/render/flow_schedule.cpp
  pbf/render/mesh.cpp
  pbf/render/environment_map.cpp
  pbf/render/nearest.cpp
  pbf/render/frame_block.cpp
  pbf/render/glsl_source.cpp
  pbf/render/read_back.cpp
  pbf/render/passes/sprites.cpp
  pbf/render/passes/fluid_tiles.cpp
  pbf/render/passes/sphere_depth.cpp
  pbf/render/passes/thickness.cpp
  pbf/render/passes/back_depth.cpp
  pbf/render/passes/backdrop.cpp
  pbf/render/passes/smooth.cpp
  pbf/render/passes/curvature_flow.cpp
  pbf/render/passes/normal.cpp
  pbf/render/passes/environment.cpp
  pbf/render/passes/opaque_meshes.cpp
  pbf/render/passes/composite.cpp
  pbf/render/passes/spheres.cpp
  pbf/render/passes/tint.cpp
  pbf/render/raster/tiles.cpp
  pbf/render/raster/map.cpp
  pbf/render/raster/surroundings.cpp
  pbf/render/raster/terms.cpp
  pbf/render/raster/panorama.cpp
  pbf/render/raster/normal.cpp
  pbf/render/raster/backdrop.cpp
  pbf/render/raster/composite.cpp
  pbf/render/raster/colored.cpp
  pbf/render/raster/opaque_meshes.cpp
  pbf/render/raster/resolve.cpp
  pbf/render/raster/layers.cpp
  pbf/render/raster/smooth.cpp
  pbf/render/raster/splats.cpp
  pbf/render/raster/deep_thickness.cpp
  pbf/render/passes/resolve.cpp
  pbf/render/raster/surface_maps.cpp
  pbf/render/raster/curvature_flow.cpp
  pbf/render/fluid_renderer.cpp)
target_link_libraries(pbf_render
  PUBLIC pbf_core
  PRIVATE ${CMAKE_DL_LIBS} OpenMP::OpenMP_CXX $<BUILD_INTERFACE:pbf_warnings>)
target_compile_options(pbf_render PRIVATE ${PBF_FLOAT_OPTIONS})

# The loops over particles and pixels.
# Thousands of vectors live on its stack; to watch each takes GCC a quarter of an hour.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_FLAGS MATCHES "sanitize=address")
  set_source_files_properties(pbf/render/raster/composite_lanes.cpp PROPERTIES
    COMPILE_OPTIONS "--param=asan-stack=0;-fno-sanitize-address-use-after-scope")
endif()
pbf_add_lanes(pbf_render
  pbf/render/extent_lanes.cpp
  pbf/render/full_cells_lanes.cpp
  pbf/render/nearest_lanes.cpp
  pbf/render/crowding_lanes.cpp
  pbf/render/shadow_lanes.cpp
  pbf/render/anisotropy_lanes.cpp
  pbf/render/raster/splats_lanes.cpp
  pbf/render/raster/deep_lanes.cpp
  pbf/render/raster/smooth_lanes.cpp
  pbf/render/raster/curvature_flow_lanes.cpp
  pbf/render/raster/normal_lanes.cpp
  pbf/render/raster/colored_lanes.cpp
  pbf/render/raster/composite_lanes.cpp)

pbf_embed_glsl(pbf_render
  frame.glsl
  sphere_outline.glsl
  sprite.vert
  sphere_hit.glsl
  sprite_hit.glsl
  sphere_depth.frag
  thickness.frag
  back_depth.frag
  fullscreen.vert
  fluid_tiles.vert
  smooth.frag
  curvature_flow.frag
  normal.frag
  environment.glsl
  display.glsl
  backdrop.frag
  opaque_meshes.vert
  opaque_meshes.frag
  tank.glsl
  refraction.glsl
  meshes.glsl
  composite.frag
  resolve.frag
  color.glsl
  spheres.vert
  spheres.frag
  sphere_shading.frag
  tint.frag
  tank_edges.vert
  tank_edges.frag)
