// The mesh, eight numbers a corner: place, colour, plan.
uniform samplerBuffer mesh_numbers;
float mesh(int at) { return texelFetch(mesh_numbers, at).x; }
uniform sampler2D imagery;
uniform vec4 extent;
uniform int images, linear;
vec3 corner(uint id, int k) { int at = (int(id) * 3 + k) * 8; return vec3(mesh(at), mesh(at + 1), mesh(at + 2)); }

// The colour of a triangle; with imagery that is what its texels are multiplied by.
vec3 ground(uint id, vec2 plan) {
  vec3 own = vec3(mesh(int(id) * 24 + 3), mesh(int(id) * 24 + 4), mesh(int(id) * 24 + 5));
  if (images == 0) return own;
  vec2 at = (plan - extent.xy) / (extent.zw - extent.xy);
  ivec2 size = textureSize(imagery, 0);
  ivec2 texel = clamp(ivec2(floor(vec2(at.x, 1.0 - at.y) * vec2(size))), ivec2(0), size - 1);
  vec3 c = texelFetch(imagery, texel, 0).rgb * own;
  if (linear == 0) return c;
  return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), greaterThan(c, vec3(0.04045)));
}
