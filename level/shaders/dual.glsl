// Numbers that carry their gradient: vec3(value, d/dx, d/dy). The twin is level/dual.py.

vec3 d_mul(vec3 a, vec3 b) { return vec3(a.x * b.x, a.x * b.yz + b.x * a.yz); }

vec3 d_const(float value) { return vec3(value, 0.0, 0.0); }

// Smoothstep from low to high with its gradient.
vec3 d_step(float low, float high, vec3 x) {
    float u = clamp((x.x - low) / (high - low), 0.0, 1.0);
    return vec3(u * u * (3.0 - 2.0 * u), 6.0 * u * (1.0 - u) / (high - low) * x.yz);
}

vec3 d_positive(vec3 x) { return x.x > 0.0 ? x : vec3(0.0); }
