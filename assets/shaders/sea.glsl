// What every shader of the scene knows of the sea: how light falls through it, and its colour along a line of sight.
// Colours are linear light until `developed` turns them into those of the screen.
uniform vec3 eye;
uniform float clear_m;    // distance of what the camera looks at [m]
uniform float hide_m;     // distance beyond it at which water hides most [m]
uniform float depth_m;    // depth of the sea [m]
uniform float time_s;     // simulated time, which moves the light of the ripples [s]
uniform vec3 water_low;   // light of water at the seabed and just below the surface
uniform vec3 water_high;
uniform vec3 sky;         // light of the air above the surface

// Direction from which the sun shines under water.
const vec3 SUN = vec3(0.26, -0.34, 0.90);
// How much water hides of red, green and blue up to what the camera looks at, and in `hide_m` beyond it (optical depths).
const vec3 BEFORE = vec3(0.30, 0.10, 0.08);
const vec3 BEYOND = vec3(1.7, 1.1, 1.0);

// Linear light of a colour of the screen. Its gamma is taken as 2, which needs no powers.
vec3 linear_of(vec3 srgb) {
    return srgb * srgb;
}

// Light that `developed` shows as this colour of the screen; as `light_of` in `draw.rs`.
vec3 light_of(vec3 srgb) {
    vec3 share = 0.95 * linear_of(srgb);
    return share / (1.0 - share);
}

// Even noise of a pixel, 0 to 1 (interleaved gradient noise, Jimenez 2014).
float noise_of(vec2 pixel) {
    return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715))));
}

// Colour of the screen of light at a pixel: a curve that brightens less and less, and half a step of noise against bands.
vec4 developed(vec3 light, float opacity, vec2 pixel) {
    light = max(light, 0.0);
    vec3 srgb = sqrt(light / (1.0 + light) / 0.95);
    return vec4(srgb + (noise_of(pixel) - 0.5) / 255.0, opacity);
}

// Light of open water at a height.
vec3 water_at(float z) {
    return mix(water_low, water_high, exp(1.9 * min(z, 0.0) / depth_m));
}

// What is seen along a line of sight where nothing stands in its way: the water (or air) as far off as the eye looks, brighter towards the sun.
vec3 backdrop(vec3 view) {
    float z = eye.z + view.z * clear_m;
    float wide = 0.004 * clear_m;
    float toward = 0.5 + 0.5 * dot(view, SUN);
    float sharp = toward * toward;
    float upward = 0.92 + view.z * (0.90 + 0.45 * view.z);
    vec3 water = water_at(z) * (upward + 0.35 * sharp + 1.2 * sharp * sharp * sharp * sharp * sharp);
    return mix(water, sky, smoothstep(-wide, wide, z));
}

// Share of daylight left at a height, by colour: enough is kept to see by, as an eye used to the dark would.
vec3 daylight(float z) {
    return mix(vec3(0.24, 0.46, 0.50), vec3(1.0), exp(1.6 * min(z, 0.0) / depth_m));
}

// Share of light, by colour, that water leaves of what is this far away.
vec3 passed(float far) {
    return exp(-(BEFORE * min(far / clear_m, 1.0) + BEYOND * max(far - clear_m, 0.0) / hide_m));
}

// How far what lies under water goes over into its colour for an eye in the air, by the way of the light through it [m]: never wholly, so that gear stays in sight.
float sunk(float way) {
    return 0.4 * (1.0 - exp(-way / 5.0));
}

// How far the eye has come out of the water, 0 to 1. A camera that rises through the surface sees no jump.
float emerged() {
    return smoothstep(0.0, 0.2 * clear_m, eye.z);
}

// Pattern of light that passes a place of the surface, 0 to 1: bright lines between dark cells.
float caustic(vec2 p) {
    for (int turn = 0; turn < 2; turn++) {
        p += 0.7 * vec2(sin(1.3 * p.y + 0.9 * time_s), cos(1.1 * p.x - 0.7 * time_s));
    }
    float ridge = 1.0 - abs(sin(p.x) + sin(p.y + 0.5 * time_s)) * 0.5;
    return pow(clamp(ridge, 0.0, 1.0), 5.0);
}

// Bright lines that ripples at the surface throw on what lies under it, along the sun's rays, 0 to 1. They blur with depth.
float ripples(vec3 at) {
    vec2 surface = at.xy - SUN.xy / SUN.z * at.z;
    return exp(min(at.z, 0.0) / 16.0) * caustic(0.8 * surface);
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
