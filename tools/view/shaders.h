#pragma once
// The shaders of pictures, in what GLSL 3.30 and GLSL ES 3.00 share; the version line is put before them. World
// means picture coordinates (camera.h: Place).

namespace argil::view::shaders {

/// One triangle over the whole target; `across` runs from 0 to 1 over the picture, upwards.
inline constexpr const char* k_whole_vertex = R"(
out vec2 across;
void main() {
  across = vec2(float((gl_VertexID << 1) & 2), float(gl_VertexID & 2));
  gl_Position = vec4(2.0 * across - 1.0, 0.0, 1.0);
})";

/// Vertical gradient, with an ordered pattern of half a level so that it shows no bands.
inline constexpr const char* k_background_fragment = R"(
precision highp float;
uniform vec3 top, bottom;
uniform vec2 tile_origin;
uniform float sampling, picture_height;
out vec4 colour;
void main() {
  vec2 sample_at = gl_FragCoord.xy + tile_origin;
  vec2 pixel = floor(sample_at / sampling);
  float noise = fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715)))) - 0.5;
  float height = (pixel.y + 0.5) / picture_height;
  colour = vec4(mix(bottom, top, smoothstep(-0.05, 1.05, height)) + noise / 255.0, 1.0);
})";

/// A picture over the whole target; tiles show their part of it.
inline constexpr const char* k_image_fragment = R"(
precision highp float;
uniform sampler2D image;
uniform vec2 tile_origin, samples;  // of the whole picture
out vec4 colour;
void main() { colour = texture(image, (gl_FragCoord.xy + tile_origin) / samples); })";

/// The same pixel of an image, times a weight.
inline constexpr const char* k_weighted_fragment = R"(
precision highp float;
uniform sampler2D image;
uniform float weight;
out vec4 colour;
void main() { colour = weight * texelFetch(image, ivec2(gl_FragCoord.xy), 0); })";

/// What is handed on is packed: each output costs time a triangle where there is no graphics card.
inline constexpr const char* k_surface_vertex = R"(
precision highp float;
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 value_and_openness;
layout(location = 3) in uvec2 cell_and_cut;
uniform mat4 clip_from_world;
uniform mat3 view_from_world;
out vec4 place_and_value, normal_and_openness;  // in axes of the view
flat out uvec2 cell_cut;
void main() {
  place_and_value = vec4(view_from_world * position, value_and_openness.x);
  normal_and_openness = vec4(view_from_world * normal, value_and_openness.y);
  cell_cut = cell_and_cut;
  gl_Position = clip_from_world * vec4(position, 1.0);
})";

/// Clay: a ramp over the light of a near lamp above left (so that flat faces are not of one colour), a soft
/// highlight, a rim, and a bounce from the ground; fields keep their colours and take only a part of the light.
inline constexpr const char* k_surface_fragment = R"(
precision highp float;
in vec4 place_and_value, normal_and_openness;
flat in uvec2 cell_cut;
uniform vec2 value_range;
uniform bool has_field;
uniform vec3 field_colours[11];
uniform vec3 eye;           // in axes of the view
uniform int brush_count;
uniform vec4 brush[2];      // middle, in axes of the view, and radius
uniform vec4 brush_tint;
uniform vec2 brush_look;    // falloff (0 smooth, 1 linear, 2 constant), width of the ring in samples
out vec4 colour;
const vec3 k_lamp = vec3(-1.5, 2.3, 2.5);

// What a brush would touch: a ring where its radius ends on the surface, a tint that fades as its strength does.
vec3 with_brushes(vec3 c) {
  for (int i = 0; i < brush_count; ++i) {
    float away = length(place_and_value.xyz - brush[i].xyz), sample_size = max(fwidth(away), 1e-9), t = away / brush[i].w;
    float strength = brush_look.x < 0.5 ? (1.0 - t * t) * (1.0 - t * t) : brush_look.x < 1.5 ? 1.0 - t : 1.0;
    if (t < 1.0) c = mix(c, brush_tint.rgb, 0.34 * strength * brush_tint.a);
    float ring = clamp(0.5 * brush_look.y + 0.5 - abs(away - brush[i].w) / sample_size, 0.0, 1.0);
    float rim = clamp(0.5 * brush_look.y + 1.6 - abs(away - brush[i].w) / sample_size, 0.0, 1.0);
    c = mix(mix(c, vec3(0.04), 0.45 * rim), brush_tint.rgb, ring * brush_tint.a);
    float dot_size = clamp(1.4 * brush_look.y + 0.5 - away / sample_size, 0.0, 1.0);
    c = mix(c, brush_tint.rgb, dot_size * brush_tint.a);
  }
  return c;
}

vec3 ramp(float t, bool lighter) {
  vec3 deep = vec3(0.150, 0.066, 0.038), shade = vec3(0.400, 0.190, 0.105), clay = vec3(0.790, 0.470, 0.295),
       light = vec3(0.940, 0.715, 0.560);
  if (lighter) {
    deep = vec3(0.300, 0.195, 0.140);
    shade = vec3(0.585, 0.425, 0.320);
    clay = vec3(0.885, 0.720, 0.580);
    light = vec3(0.985, 0.885, 0.790);
  }
  vec3 c = mix(deep, shade, smoothstep(0.0, 0.40, t));
  c = mix(c, clay, smoothstep(0.24, 0.80, t));
  return mix(c, light, smoothstep(0.76, 1.04, t));
}

vec3 field_colour(float t) {
  float s = clamp(t, 0.0, 1.0) * 10.0;
  int i = int(min(floor(s), 9.0));
  return mix(field_colours[i], field_colours[i + 1], s - float(i));
}

void main() {
  vec3 n = normalize(normal_and_openness.xyz), v = normalize(eye - place_and_value.xyz);
  float value = place_and_value.w, openness = normal_and_openness.w;
  if (dot(n, v) < 0.0 && !gl_FrontFacing) n = -n;
  vec3 key = normalize(k_lamp - place_and_value.xyz), fill = normalize(vec3(0.85, 0.10, 0.45));
  float open = mix(0.30, 1.0, openness);
  float facing = clamp(dot(n, v), 0.0, 1.0);
  float lit = 0.5 + 0.5 * dot(n, key);
  float rim = pow(1.0 - facing, 3.0);
  float gloss = pow(max(dot(n, normalize(key + v)), 0.0), 26.0);
  if (has_field) {
    float t = (value - value_range.x) / max(value_range.y - value_range.x, 1e-30);
    float light = mix(0.66, 1.14, smoothstep(0.05, 0.95, lit)) * mix(0.62, 1.0, openness);
    colour = vec4(field_colour(t) * light + (0.09 * gloss + 0.14 * rim + 0.035 * lit) * open, 1.0);
    colour.rgb = with_brushes(colour.rgb);
    return;
  }
  float t = lit * mix(0.42, 1.0, openness) + 0.07 * max(dot(n, fill), 0.0) * open;
  vec3 c = ramp(t, cell_cut.y != 0u);
  c += vec3(1.00, 0.90, 0.78) * 0.13 * gloss * open;
  c += mix(vec3(0.36, 0.20, 0.13), vec3(0.55, 0.42, 0.36), 0.5 + 0.5 * n.y) * 0.34 * rim * open;
  c += vec3(0.10, 0.050, 0.028) * max(-n.y, 0.0) * open;
  colour = vec4(with_brushes(c), 1.0);
})";

/// Matte and translucent, a little denser where it turns away; `value` is an opacity.
inline constexpr const char* k_obstacle_fragment = R"(
precision highp float;
in vec4 place_and_value, normal_and_openness;
flat in uvec2 cell_cut;
uniform vec3 eye;
uniform vec4 tint;
out vec4 colour;
const vec3 k_lamp = vec3(-1.5, 2.3, 2.5);
void main() {
  vec3 n = normalize(normal_and_openness.xyz), v = normalize(eye - place_and_value.xyz);
  float value = place_and_value.w;
  if (dot(n, v) < 0.0) n = -n;
  float lit = 0.5 + 0.5 * dot(n, normalize(k_lamp - place_and_value.xyz));
  float rim = pow(1.0 - clamp(dot(n, v), 0.0, 1.0), 3.0);
  colour = vec4(tint.rgb * mix(0.55, 1.12, lit), value * mix(tint.a, min(1.0, tint.a + 0.3), rim));
})";

inline constexpr const char* k_id_fragment = R"(
precision highp float;
in vec4 place_and_value, normal_and_openness;
flat in uvec2 cell_cut;
out vec4 colour;
void main() {
  uint cell = cell_cut.x;
  uvec4 bytes = uvec4(cell, cell >> 8u, cell >> 16u, cell >> 24u) & 255u;
  colour = vec4(bytes) / 255.0;
})";

/// Depth along a direction as three bytes, for the openness of vertices.
inline constexpr const char* k_depth_fragment = R"(
precision highp float;
in vec4 place_and_value, normal_and_openness;
flat in uvec2 cell_cut;
out vec4 colour;
void main() {
  uint depth = uint(gl_FragCoord.z * 16777215.0);
  colour = vec4(uvec4(depth, depth >> 8u, depth >> 16u, 255u) & 255u) / 255.0;
})";

/// What stands over a place of the ground, seen from above: near the ground (red) and at any height (green).
inline constexpr const char* k_footprint_vertex = R"(
precision highp float;
layout(location = 0) in vec3 position;
uniform vec4 ground;  // middle and half size
uniform float ground_height;
out float height;
void main() {
  height = position.z - ground_height;
  gl_Position = vec4((position.xy - ground.xy) / ground.zw, 0.0, 1.0);
})";
inline constexpr const char* k_footprint_fragment = R"(
precision highp float;
in float height;
out vec4 colour;
void main() { colour = vec4(exp(-9.0 * height), exp(-1.3 * height), 0.0, 1.0); })";

inline constexpr const char* k_blur_fragment = R"(
precision highp float;
in vec2 across;
uniform sampler2D image;
uniform vec2 stride;  // one standard deviation / 2.5
out vec4 colour;
void main() {
  vec4 sum = vec4(0.0);
  float weight = 0.0;
  for (int i = -6; i <= 6; ++i) {
    float w = exp(-float(i * i) / 12.5);
    sum += w * texture(image, across + float(i) * stride);
    weight += w;
  }
  colour = sum / weight;
})";

/// Both shadows as one, gone at the rim of the ground.
inline constexpr const char* k_shade_fragment = R"(
precision highp float;
in vec2 across;
uniform sampler2D close, wide;
out vec4 colour;
void main() {
  vec2 edge = smoothstep(vec2(0.0), vec2(0.12), across) * smoothstep(vec2(0.0), vec2(0.12), 1.0 - across);
  float shade = 1.0 - (1.0 - 0.80 * texture(close, across).r) * (1.0 - texture(wide, across).g);
  colour = vec4(shade * edge.x * edge.y);
})";

inline constexpr const char* k_ground_vertex = R"(
precision highp float;
uniform mat4 clip_from_world;
uniform vec4 ground;
uniform float ground_height;
out vec2 across;
void main() {
  across = vec2(float(gl_VertexID & 1), float(gl_VertexID >> 1));
  gl_Position = clip_from_world * vec4(ground.xy + (2.0 * across - 1.0) * ground.zw, ground_height, 1.0);
})";
inline constexpr const char* k_ground_fragment = R"(
precision highp float;
in vec2 across;
uniform sampler2D shade;
uniform float opacity;
out vec4 colour;
void main() { colour = vec4(0.02, 0.02, 0.025, opacity * texture(shade, across).r); })";

/// Lines with a width in pixels, one instance a line. They are drawn a little nearer to the eye, along the ray, so
/// that they lie on the surface. Short and distant ones fade, so that fine meshes do not turn black.
inline constexpr const char* k_line_vertex = R"(
precision highp float;
layout(location = 0) in vec3 start;
layout(location = 1) in vec3 end;
uniform mat4 clip_from_world;
uniform vec3 eye;
uniform vec2 half_size;       // of the picture, in samples
uniform float half_width;     // in samples
uniform vec2 visible_length;  // in samples: faded out, fully there
uniform vec3 distances;       // nearest, farthest, what is left of the opacity at the farthest
out float side, strength;
void main() {
  vec4 a = clip_from_world * vec4(mix(start, eye, 0.0015), 1.0);
  vec4 b = clip_from_world * vec4(mix(end, eye, 0.0015), 1.0);
  vec2 from = a.xy / a.w * half_size, to = b.xy / b.w * half_size, along = to - from;
  float size = length(along);
  along = size > 1e-5 ? along / size : vec2(1.0, 0.0);
  bool second = gl_VertexID >= 2;
  vec4 clip = second ? b : a;
  side = ((gl_VertexID & 1) == 1 ? 1.0 : -1.0) * (half_width + 1.0);
  vec2 place = (second ? to : from) + vec2(-along.y, along.x) * side;
  gl_Position = vec4(place / half_size * clip.w, clip.z, clip.w);
  float far = clamp((clip.w - distances.x) / max(distances.y - distances.x, 1e-6), 0.0, 1.0);
  strength = smoothstep(visible_length.x, visible_length.y, size) * mix(1.0, distances.z, far);
})";
inline constexpr const char* k_line_fragment = R"(
precision highp float;
in float side, strength;
uniform float half_width;
uniform vec4 tint;
out vec4 colour;
void main() {
  float cover = clamp(half_width + 0.5 - abs(side), 0.0, 1.0);
  colour = vec4(tint.rgb, tint.a * cover * strength);
})";

/// Marks of fixed size in pixels, one instance a mark: 0 a disc about the place, 1 a triangle pointing at it from
/// below.
inline constexpr const char* k_mark_vertex = R"(
precision highp float;
layout(location = 0) in vec3 centre;
uniform mat4 clip_from_world;
uniform vec3 eye;
uniform vec2 half_size;
uniform float radius, outline, forward;
uniform int shape;
out vec2 place;  // in samples from the centre
void main() {
  vec2 corner = vec2(float(gl_VertexID & 1), float(gl_VertexID >> 1)) * 2.0 - 1.0;
  place = corner * (radius + outline + 1.0);
  vec4 clip = clip_from_world * vec4(mix(centre, eye, forward), 1.0);
  vec2 shift = shape == 1 ? vec2(0.0, -1.35 * radius) : vec2(0.0);
  gl_Position = vec4(clip.xy + (place + shift) / half_size * clip.w, clip.z, clip.w);
})";
inline constexpr const char* k_mark_fragment = R"(
precision highp float;
in vec2 place;
uniform float radius, outline, opacity;
uniform int shape;
uniform vec4 tint, ring;
out vec4 colour;
void main() {
  float away = length(place) - radius;  // distance from the rim, negative inside
  if (shape == 1) {
    vec2 p = vec2(abs(place.x), place.y);
    away = max(dot(p - vec2(0.0, radius), vec2(0.8575, 0.5145)), -place.y - 0.667 * radius);
  }
  float inside = clamp(0.5 - away, 0.0, 1.0), around = clamp(outline + 0.5 - away, 0.0, 1.0);
  float alpha = mix(ring.a * around, tint.a, inside);
  if (alpha <= 0.003) discard;
  colour = vec4(mix(ring.rgb, tint.rgb, inside), alpha * opacity);
})";

/// Arrows, thickened by `grow` pixels for their outline.
inline constexpr const char* k_arrow_vertex = R"(
precision highp float;
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform mat4 clip_from_world;
uniform mat3 view_from_world;
uniform float grow;
out vec3 view_normal;
void main() {
  view_normal = view_from_world * normal;
  float distance = (clip_from_world * vec4(position, 1.0)).w;
  gl_Position = clip_from_world * vec4(position + normal * grow * distance, 1.0);
})";
inline constexpr const char* k_arrow_fragment = R"(
precision highp float;
in vec3 view_normal;
uniform vec4 tint;
uniform float shading;
out vec4 colour;
void main() {
  float lit = 0.5 + 0.5 * dot(normalize(view_normal), normalize(vec3(-0.42, 0.66, 0.62)));
  colour = vec4(tint.rgb * mix(1.0, mix(0.72, 1.12, lit), shading), tint.a);
})";

}  // namespace argil::view::shaders
