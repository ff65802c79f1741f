// Daylight from above that fades with depth, water that hides what is far, a sandy seabed with grid lines, wet skin.
uniform int look;         // 0 solid, 1 own colour, 2 seabed, 3 surface, 4 skin, 5 rope, 6 its edge
uniform float grid_m;     // distance of the seabed's lines [m]

in vec3 world;
in vec3 outward;
in vec4 tint;
in vec3 own;              // place on the body at rest, where its grain sticks [m]

out vec4 shown;

const vec3 SUN = vec3(0.26, -0.34, 0.90);
// Cosine of the angle from straight up within which light enters the sea: asin(1/1.34) = 48.3 degrees.
const float WINDOW = 0.665;

float lines(vec2 at, float spacing) {
    vec2 cell = at / spacing;
    vec2 wide = fwidth(cell);
    vec2 near = abs(fract(cell - 0.5) - 0.5) / max(wide, vec2(1e-6));
    vec2 fine = clamp(1.2 - 2.0 * wide, 0.0, 1.0);
    vec2 line = clamp(1.2 - near, 0.0, 1.0) * fine;
    return max(line.x, line.y);
}

// Light on a surface: sky above, seabed's dim return below, sun with the ripples' play, a rim against the water.
vec3 lit(vec3 colour, vec3 n, vec3 view, float rim) {
    float sky_light = 0.46 + 0.30 * n.z;
    float sun = max(dot(n, SUN), 0.0) * (0.56 + 0.75 * ripples(world));
    vec3 edge = rim * pow(1.0 - abs(dot(n, view)), 3.0) * vec3(0.45, 0.68, 0.78);
    return (colour * (sky_light + sun) + edge) * daylight(world.z);
}

// A mark's share in the colour between two corners, drawn to an uneven edge.
float marked(float share, float uneven) {
    float between = 4.0 * share * (1.0 - share);
    return smoothstep(0.42, 0.58, share + 0.40 * between * uneven);
}

// Skin's colour and how dull it is. Between skin and a mark both change evenly; here callosities and white patches get an edge.
vec4 marks() {
    float dull = 1.0 - tint.a;
    if (dull > 0.01 && distance(tint.rgb, mix(SKIN, CALLOSITY, dull)) < 0.03) {
        dull = marked(dull, grain_at(own * 7.0) + 0.6 * grain_at(own * 17.0));
        return vec4(mix(SKIN, CALLOSITY, dull), dull);
    }
    float white = (tint.r - SKIN.r) / (WHITE.r - SKIN.r);
    if (dull < 0.01 && distance(tint.rgb, mix(SKIN, WHITE, white)) < 0.03) {
        return vec4(mix(SKIN, WHITE, marked(white, 1.5 * grain_at(own * 1.9) + 0.6 * grain_at(own * 6.0))), dull);
    }
    return vec4(tint.rgb, dull);
}

// Skin: dark and mottled, wet and glossy where it is smooth; rough patches stay dull. Its tint's fourth part says how smooth.
vec3 skin(vec3 n, vec3 view) {
    vec4 mark = marks();
    float dull = mark.a;
    float mottle = 0.6 * grain_at(own * 2.3) + 0.4 * grain_at(own * 9.0);
    float rough = grain_at(own * 16.0);
    vec3 colour = mark.rgb * (1.0 + mix(0.13 * mottle, 0.30 * rough, dull));
    vec3 tilt = vec3(grain_at(own * 14.0 + 7.0), grain_at(own * 14.0 + 31.0), rough);
    vec3 m = normalize(n + mix(0.03, 0.16, dull) * tilt);
    float gloss = pow(max(dot(reflect(view, m), SUN), 0.0), 22.0);
    return lit(colour, m, view, 0.34) + (1.0 - dull) * gloss * vec3(0.20, 0.24, 0.25) * daylight(world.z);
}

// Laid rope: three strands that turn to the right, as far as they are wide enough to be seen. Its grain is the place along it and
// the direction round it.
vec3 rope(vec3 n, vec3 view) {
    const float LAY_M = 0.035;
    float turn = atan(own.z, own.y) / 6.2831853 - own.x / LAY_M;
    float seen = clamp(1.3 - 8.0 * fwidth(own.x) / LAY_M, 0.0, 1.0);
    float strands = mix(1.0, 0.80 + 0.20 * cos(3.0 * 6.2831853 * turn), seen);
    float round = 0.62 + 0.38 * abs(dot(n, view));
    return tint.rgb * strands * round * (0.94 + 0.10 * n.z);
}

// Sand in low ridges, and lines to measure by.
vec3 seabed(float far) {
    float fine = exp(-far / 60.0);
    float sand = 0.5 * grain_at(world * vec3(0.13, 0.13, 0.0)) + fine * 0.5 * grain_at(world * vec3(1.1, 0.5, 0.0));
    vec3 colour = tint.rgb * (1.0 + 0.16 * sand + 1.2 * ripples(world)) * daylight(world.z);
    float line = max(0.20 * lines(world.xy, grid_m), 0.055 * lines(world.xy, grid_m * 0.1));
    return colour + line * vec3(0.45, 0.60, 0.62);
}

// The surface. From below: daylight within its round window overhead, the deep mirrored beyond; from above: a veil.
vec4 surface(vec3 view, float hide) {
    vec2 wave = vec2(grain_at(vec3(world.xy * 0.55, 0.35 * time_s)), grain_at(vec3(world.yx * 0.55 + 9.0, 0.35 * time_s)));
    float up = abs(normalize(vec3(view.xy + 0.10 * wave, view.z)).z);
    float flat_angle = pow(1.0 - abs(view.z), 3.0);
    if (eye.z > 0.0) {
        vec3 veil = mix(mix(tint.rgb, water_high, 0.7), sky, 0.15 + 0.7 * flat_angle);
        float thick = mix(0.10, 0.50, flat_angle) + 0.06 * lines(world.xy, grid_m);
        return vec4(veil, thick * emerged() * (1.0 - hide));
    }
    float within = smoothstep(WINDOW - 0.16, WINDOW + 0.10, up);
    vec3 colour = mix(water_at(-0.35 * depth_m) * (1.0 + 0.10 * wave.x), mix(water_high, sky, 0.75) * (1.0 + 0.12 * wave.y), within);
    colour += 0.04 * lines(world.xy, grid_m);
    return vec4(mix(colour, backdrop(view), hide), 0.60);
}

void main() {
    vec3 sight = world - eye;
    float far = length(sight);
    vec3 view = sight / far;
    vec3 n = normalize(outward);
    if (!gl_FrontFacing) { n = -n; }
    float hide = 1.0 - exp(-max(far - clear_m, 0.0) / hide_m);
    vec3 colour = tint.rgb;
    if (look == 3) {
        shown = surface(view, hide);
        return;
    }
    if (look == 0) {
        colour = lit(colour, n, view, 0.16);
    } else if (look == 1) {
        colour *= 0.80 + 0.20 * abs(dot(n, view));
    } else if (look == 2) {
        colour = seabed(far);
    } else if (look == 5) {
        colour = rope(n, view);
    } else if (look == 6) {
        colour = vec3(0.03, 0.09, 0.13);
    } else {
        colour = skin(n, view);
    }
    if (eye.z > 0.0 && world.z < 0.0) {
        float way = far * world.z / (world.z - eye.z);
        colour = mix(colour, mix(water_low, water_high, 0.6), emerged() * sunk(way));
    }
    shown = vec4(mix(colour, backdrop(view), hide), 1.0);
}
