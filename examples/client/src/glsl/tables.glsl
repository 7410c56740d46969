// Tables of whole numbers and of single precision. (Storage buffers would be nicer: Mesa 22.3's llvmpipe loses reads of them in loops.)
uniform usamplerBuffer whole_numbers;
uniform samplerBuffer single_numbers;
const uint NONE = 0xffffffffu;
uint whole(int at) { return texelFetch(whole_numbers, at).x; }
float single(int at) { return texelFetch(single_numbers, at).x; }
vec2 pair(int at) { return vec2(single(at), single(at + 1)); }
