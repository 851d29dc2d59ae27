#include "algorithms/froxels/shape_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ml {
namespace {

// Half-angles (radians) up to which the hull of a cone is drawn together at the apex, and beyond which the
// cone does not bound the light.
constexpr double widest_pyramid = 0.9, widest_cone = 1.5;

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

// Window coordinates and depths (m) that a volume covers.
struct ViewBounds {
  Range across, up, depth;
  bool window_known = true;  // false: part of it lies before the near plane, and only the depths are bounds
};

// What single precision may take from positions and directions in the shading pass, in metres.
double slack(const gpu_data::LightCore& core, const gpu_data::LightExtra& extra) {
  return 2e-5 * static_cast<double>(extra.bound_radius) +
         2e-6 * static_cast<double>(std::abs(core.position.x) + std::abs(core.position.y) +
                                    std::abs(core.position.z));
}

ViewBounds bounds_of_corners(const gpu_data::ViewData& view, const HullCorners& corners, double slack) {
  ViewBounds bounds;
  for (const glm::dvec3& corner : corners) {
    const double x = glm::dot(corner, glm::dvec3(view.right)), y = glm::dot(corner, glm::dvec3(view.up));
    const double z = glm::dot(corner, glm::dvec3(view.forward));
    bounds.depth.add(z - slack);
    bounds.depth.add(z + slack);
    const bool orthographic = view.orthographic != 0;
    if (!orthographic && z - slack < static_cast<double>(view.near)) bounds.window_known = false;
    for (double side : {-slack, slack})
      for (double along : {-slack, slack}) {
        bounds.across.add(orthographic ? x + side : (x + side) / (z + along));
        bounds.up.add(orthographic ? y + side : (y + side) / (z + along));
      }
  }
  return bounds;
}

struct CellRange {
  uint32_t x0, x1, y0, y1, z0, z1;
};

CellRange cells_of(const LightBox& box, const FroxelGrid& grid) {
  const uint32_t x0 = box.first % grid.columns, y0 = box.first / grid.columns % grid.rows,
                 z0 = box.first / grid.columns / grid.rows;
  return {x0, x0 + box.columns - 1, y0, y0 + box.rows - 1, z0, z0 + box.slices - 1};
}

void put(const CellRange& cells, LightBox& box, const FroxelGrid& grid) {
  if (cells.x0 > cells.x1 || cells.y0 > cells.y1 || cells.z0 > cells.z1) {
    box = {0, box.light, 0, 0, 0};
    return;
  }
  box.first = grid.cell(cells.x0, cells.y0, cells.z0);
  box.columns = static_cast<uint16_t>(cells.x1 - cells.x0 + 1);
  box.rows = static_cast<uint16_t>(cells.y1 - cells.y0 + 1);
  box.slices = cells.z1 - cells.z0 + 1;
}

// First and last tile whose pixel centres lie between two positions in pixels; `low` > `high` for none.
void narrow(double pixel0, double pixel1, double last_pixel, uint32_t tile, uint32_t& low, uint32_t& high) {
  const double slack = static_cast<double>(widen_pixels) + 0.01;
  pixel0 = std::max(std::ceil(pixel0 - 0.5 - slack), 0.0);
  pixel1 = std::min(std::floor(pixel1 - 0.5 + slack), last_pixel);
  if (!(pixel0 <= pixel1)) {
    low = 1;
    high = 0;
    return;
  }
  low = std::max(low, static_cast<uint32_t>(pixel0) / tile);
  high = std::min(high, static_cast<uint32_t>(pixel1) / tile);
}

// Both ends of a capsule as balls: their bounds together hold all between, as long as both are wholly in
// front.
bool capsule_box(const BoundsConstants& c, const gpu_data::LightCore& core, const gpu_data::LightExtra& extra,
                 CellRange& cells, DepthInterval& depth) {
  FroxelBox ends[2];
  DepthInterval depths[2];
  for (int end = 0; end < 2; ++end) {
    const glm::vec3 at = core.position + extra.side * (end == 0 ? -extra.half_length : extra.half_length);
    const float radius = core.radius * 1.0001f + static_cast<float>(slack(core, extra));
    const float z = glm::dot(at, c.view.forward);
    if (!(z - radius >= c.view.near)) return false;
    ends[end] = scalar::bound_ball(c, glm::dot(at, c.view.right), glm::dot(at, c.view.up), z, radius);
    depths[end] = scalar::depth_interval(z, radius);
    // An end outside the picture says nothing of what lies between.
    if (ends[end].empty()) return false;
  }
  cells.x0 = std::max<uint32_t>(cells.x0, std::min(ends[0].x0, ends[1].x0));
  cells.x1 = std::min<uint32_t>(cells.x1, std::max(ends[0].x1, ends[1].x1));
  cells.y0 = std::max<uint32_t>(cells.y0, std::min(ends[0].y0, ends[1].y0));
  cells.y1 = std::min<uint32_t>(cells.y1, std::max(ends[0].y1, ends[1].y1));
  cells.z0 = std::max<uint32_t>(cells.z0, std::min(ends[0].z0, ends[1].z0));
  cells.z1 = std::min<uint32_t>(cells.z1, std::max(ends[0].z1, ends[1].z1));
  depth.low = std::max(depth.low, std::min(depths[0].low, depths[1].low));
  depth.high = std::min(depth.high, std::max(depths[0].high, depths[1].high));
  return true;
}

}  // namespace

bool hull_corners(const gpu_data::LightCore& core, const gpu_data::LightExtra& extra, HullCorners& corners) {
  const uint32_t shape = core.id_shape >> 24;
  if (shape == ML_SHAPE_OMNI || shape == ML_SHAPE_CAPSULE) return false;
  const glm::dvec3 center(core.position);
  glm::dvec3 front(extra.direction), side(extra.side);
  // Half extents across and up at the near and the far end, and where those are along `front`.
  glm::dvec2 near_half, far_half;
  double near_end, far_end;
  if (shape == ML_SHAPE_BOX) {
    const glm::dvec3 half(gpu_data::box_half_extents(extra));
    near_half = far_half = {half.x, half.y};
    near_end = -half.z;
    far_end = half.z;
  } else {
    // The shader compares cosines: what they may be off by is much for a narrow cone.
    const double angle = std::acos(std::clamp(static_cast<double>(extra.cos_outer) - 4e-6, -1.0, 1.0));
    if (!(angle < widest_cone)) return false;
    if (shape == ML_SHAPE_SPOT) {
      const glm::dvec3 other = std::abs(front.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
      side = glm::normalize(glm::cross(front, other));
    }
    const double length = shape == ML_SHAPE_WEDGE ? static_cast<double>(extra.half_length) : 0.0;
    const auto radius = static_cast<double>(core.radius);
    const bool pyramid = angle <= widest_pyramid;
    const double wide = pyramid ? radius * std::tan(angle) : radius * std::sin(angle);
    near_half = pyramid ? glm::dvec2(length, 0) : glm::dvec2(length + wide, wide);
    far_half = {length + wide, wide};
    near_end = 0;
    far_end = radius;
  }
  const glm::dvec3 up = glm::cross(front, side);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec2 half = corner < 4 ? near_half : far_half;
    corners[corner] = center + front * (corner < 4 ? near_end : far_end) +
                      side * (corner & 1 ? half.x : -half.x) + up * (corner & 2 ? half.y : -half.y);
  }
  return true;
}

void tighten(const BoundsConstants& c, const gpu_data::LightCore& core, const gpu_data::LightExtra& extra,
             LightBox& box, DepthInterval& depth) {
  if (box.columns == 0) return;
  CellRange cells = cells_of(box, c.grid);
  HullCorners corners;
  if (core.id_shape >> 24 == ML_SHAPE_CAPSULE) {
    if (!capsule_box(c, core, extra, cells, depth)) return;
  } else {
    if (!hull_corners(core, extra, corners)) return;
    const ViewBounds bounds = bounds_of_corners(c.view, corners, slack(core, extra));
    depth.low = std::max(depth.low, static_cast<float>(bounds.depth.low) * 0.99999f);
    depth.high = std::min(depth.high, static_cast<float>(bounds.depth.high) * 1.00001f);
    cells.z0 = std::max(cells.z0, gpu_data::slice_of_depth(depth.low, c.grid.mapping));
    cells.z1 = std::min(cells.z1, gpu_data::slice_of_depth(depth.high, c.grid.mapping));
    if (bounds.window_known) {
      auto pixel = [](double window, float edge, float scale) {
        return (window - static_cast<double>(edge)) * static_cast<double>(scale);
      };
      narrow(pixel(bounds.across.low, c.left_edge, c.x_pixels_per_unit),
             pixel(bounds.across.high, c.left_edge, c.x_pixels_per_unit),
             static_cast<double>(c.last_column_pixel), c.grid.tile, cells.x0, cells.x1);
      narrow(pixel(bounds.up.high, c.top_edge, c.y_pixels_per_unit),
             pixel(bounds.up.low, c.top_edge, c.y_pixels_per_unit), static_cast<double>(c.last_row_pixel),
             c.grid.tile, cells.y0, cells.y1);
    }
  }
  put(cells, box, c.grid);
}

}  // namespace ml
