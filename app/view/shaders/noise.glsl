// Value noise with its gradient: xyz slope, w value, about -1 to 1. An integer hash gives the same
// pattern with every driver.
float lattice(ivec3 p) {
  uint h = uint(p.x) * 0x8da6b343u + uint(p.y) * 0xd8163841u + uint(p.z) * 0xcb1ab31fu;
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12)) * 0x297a2d39u;
  return float(h >> 8) * (2.0 / 16777215.0) - 1.0;
}
vec4 noise(vec3 p) {
  vec3 cell = floor(p), f = p - cell;
  ivec3 i = ivec3(cell);
  vec3 u = f * f * (3.0 - 2.0 * f), du = 6.0 * f * (1.0 - f);
  float a = lattice(i), b = lattice(i + ivec3(1, 0, 0)), c = lattice(i + ivec3(0, 1, 0)),
        d = lattice(i + ivec3(1, 1, 0)), e = lattice(i + ivec3(0, 0, 1)),
        g = lattice(i + ivec3(1, 0, 1)), h = lattice(i + ivec3(0, 1, 1)),
        k = lattice(i + ivec3(1, 1, 1));
  float k1 = b - a, k2 = c - a, k3 = e - a, k4 = a - b - c + d, k5 = a - c - e + h,
        k6 = a - b - e + g, k7 = b + c + e - a - d - h - g + k;
  return vec4(du * vec3(k1 + k4 * u.y + k6 * u.z + k7 * u.y * u.z,
                        k2 + k5 * u.z + k4 * u.x + k7 * u.z * u.x,
                        k3 + k6 * u.x + k5 * u.y + k7 * u.x * u.y),
              a + k1 * u.x + k2 * u.y + k3 * u.z + k4 * u.x * u.y + k5 * u.y * u.z +
                  k6 * u.z * u.x + k7 * u.x * u.y * u.z);
}
