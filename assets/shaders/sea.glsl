// What every shader of the scene knows of the sea: how light falls through it, and its colour along a line of sight.
uniform vec3 eye;
uniform float clear_m;    // distance up to which water hides nothing [m]
uniform float hide_m;     // distance beyond it at which two thirds are hidden [m]
uniform float depth_m;    // depth of the sea [m]
uniform float time_s;     // simulated time, which moves the light of the ripples [s]
uniform vec3 water_low;   // water at the seabed and just below the surface
uniform vec3 water_high;
uniform vec3 sky;         // air above the surface

// Colour of open water at a height.
vec3 water_at(float z) {
    return mix(water_low, water_high, exp(1.9 * min(z, 0.0) / depth_m));
}

// What is seen along a line of sight where nothing stands in its way: the water (or air) as far off as the eye looks.
vec3 backdrop(vec3 view) {
    float z = eye.z + view.z * clear_m;
    float wide = 0.004 * clear_m;
    return mix(water_at(z), sky, smoothstep(-wide, wide, z));
}

// Share of daylight left at a height: enough is kept to see by, as an eye used to the dark would.
float daylight(float z) {
    return mix(0.66, 1.0, exp(1.4 * min(z, 0.0) / depth_m));
}

// How far what lies under water goes over into its colour for an eye in the air, by the way of the light through it [m]: never wholly, so that gear stays in sight.
float sunk(float way) {
    return 0.4 * (1.0 - exp(-way / 5.0));
}

// How far the eye has come out of the water, 0 to 1. A camera that rises through the surface sees no jump.
float emerged() {
    return smoothstep(0.0, 0.2 * clear_m, eye.z);
}

// Bright lines that ripples at the surface throw on what lies near under it, 0 to 1.
float ripples(vec3 at) {
    vec2 p = at.xy * 0.8 + 0.15 * at.z;
    for (int turn = 0; turn < 2; turn++) {
        p += 0.7 * vec2(sin(1.3 * p.y + 0.9 * time_s), cos(1.1 * p.x - 0.7 * time_s));
    }
    float ridge = 1.0 - abs(sin(p.x) + sin(p.y + 0.5 * time_s)) * 0.5;
    float near = exp(min(at.z, 0.0) / 9.0);
    return near * pow(clamp(ridge, 0.0, 1.0), 5.0);
}

// Uneven grain of a surface, -1 to 1: smooth noise on a lattice of unit cells.
float lattice(vec3 corner) {
    vec3 p = fract(corner * vec3(0.1031, 0.1030, 0.0973));
    p += dot(p, p.yxz + 33.33);
    return fract((p.x + p.y) * p.z);
}

float grain_at(vec3 at) {
    vec3 cell = floor(at);
    vec3 part = at - cell;
    part = part * part * (3.0 - 2.0 * part);
    vec2 step = vec2(0.0, 1.0);
    vec4 low = vec4(lattice(cell), lattice(cell + step.yxx), lattice(cell + step.xyx), lattice(cell + step.yyx));
    vec4 high = vec4(lattice(cell + step.xxy), lattice(cell + step.yxy), lattice(cell + step.xyy), lattice(cell + step.yyy));
    vec4 level = mix(low, high, part.z);
    vec2 row = mix(level.xz, level.yw, part.x);
    return 2.0 * mix(row.x, row.y, part.y) - 1.0;
}
