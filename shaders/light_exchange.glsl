// Lights handed around a subgroup: each lane fetches one, so that a light is fetched once for all of them. All lanes
// must take part.
#ifndef ML_LIGHT_EXCHANGE_GLSL
#define ML_LIGHT_EXCHANGE_GLSL
#include "shaders/light_eval.glsl"
#include "shaders/subgroup_exchange.glsl"

vec3 of_lane(vec3 value, uint lane) {
  return vec3(subgroupShuffle(value.x, lane), subgroupShuffle(value.y, lane), subgroupShuffle(value.z, lane));
}

LightCore broadcast_light(LightCore own, uint lane) {
  LightCore light;
  light.position = of_lane(own.position, lane);
  light.radius = subgroupShuffle(own.radius, lane);
  light.intensity = of_lane(own.intensity, lane);
  light.id_shape = subgroupShuffle(own.id_shape, lane);
  return light;
}

// Of a light fetched before it is known whether its shape needs one: the first light's where it does not, for in a
// frame of omni lights there are no more.
LightExtra extra_ahead(LightCore light) { return extra_at(has_extra(light) ? light.id_shape & ML_LIGHT_ID_MASK : 0u); }

LightExtra broadcast_extra(LightExtra own, uint lane) {
  LightExtra extra;
  extra.direction = of_lane(own.direction, lane);
  extra.half_length = subgroupShuffle(own.half_length, lane);
  extra.side = of_lane(own.side, lane);
  extra.cone_scale = subgroupShuffle(own.cone_scale, lane);
  extra.cone_limit = subgroupShuffle(own.cone_limit, lane);
  extra.cos_outer = subgroupShuffle(own.cos_outer, lane);
  extra.bound_radius = subgroupShuffle(own.bound_radius, lane);
  extra.spare = 0.0;
  return extra;
}

#endif
