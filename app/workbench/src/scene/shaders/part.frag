// Light from above, water that hides what is far, grid lines on the seabed.
uniform vec3 eye;
uniform int look;         // 0 solid, 1 own colour, 2 seabed, 3 surface
uniform float grid_m;     // distance of the seabed's lines [m]
uniform float clear_m;    // distance up to which water hides nothing [m]
uniform float hide_m;     // distance beyond it at which two thirds are hidden [m]
uniform vec3 water_low;   // water at the bottom and at the top of the picture
uniform vec3 water_high;
uniform float height_px;

in vec3 world;
in vec3 outward;
in vec4 tint;

out vec4 shown;

const vec3 SUN = vec3(0.26, -0.34, 0.90);

float lines(vec2 at, float spacing) {
    vec2 cell = at / spacing;
    vec2 wide = fwidth(cell);
    vec2 near = abs(fract(cell - 0.5) - 0.5) / max(wide, vec2(1e-6));
    vec2 fine = clamp(1.2 - 2.0 * wide, 0.0, 1.0);
    vec2 line = clamp(1.2 - near, 0.0, 1.0) * fine;
    return max(line.x, line.y);
}

void main() {
    vec3 sight = world - eye;
    float far = length(sight);
    vec3 view = sight / far;
    vec3 n = normalize(outward);
    if (!gl_FrontFacing) { n = -n; }
    vec3 colour = tint.rgb;
    float opacity = tint.a;
    float hide = 1.0 - exp(-max(far - clear_m, 0.0) / hide_m);
    if (look == 0) {
        float sky = 0.42 + 0.30 * n.z;
        float sun = 0.62 * max(dot(n, SUN), 0.0);
        float rim = 0.22 * pow(1.0 - abs(dot(n, view)), 3.0);
        colour = colour * (sky + sun) + rim * vec3(0.55, 0.75, 0.82);
    } else if (look == 1) {
        colour *= 0.80 + 0.20 * abs(dot(n, view));
    } else if (look == 2) {
        float line = max(0.30 * lines(world.xy, grid_m), 0.10 * lines(world.xy, grid_m * 0.1));
        colour += line * vec3(0.45, 0.60, 0.62);
    } else if (look == 3) {
        float flat_angle = pow(1.0 - abs(dot(n, view)), 3.0);
        opacity = mix(0.10, 0.42, flat_angle) + 0.10 * lines(world.xy, grid_m);
        opacity *= 1.0 - hide;
    }
    vec3 water = mix(water_low, water_high, gl_FragCoord.y / height_px);
    shown = vec4(mix(colour, water, look == 3 ? 0.0 : hide), opacity);
}
