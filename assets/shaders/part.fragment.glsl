// Daylight from above that fades with depth, water that hides what is far, a sandy seabed with grid lines, wet skin.
// The program is made once for each look, with the constants LOOK and FILM, SKIN, CALLOSITY and WHITE in front of this text (`shaders.rs`).
// LOOK is 0 for solid, 1 own colour, 2 seabed, 3 surface, 4 skin, 5 rope, 6 its edge.
// FILM stands for a picture without instruments: rope is lit as everything else.
uniform float grid_m;     // distance of the lines of seabed and surface [m]; 0 for none

in vec3 world;
in vec3 outward;
in vec4 tint;
in vec3 own;              // place on the body at rest, where its grain sticks [m]

out vec4 shown;

float lines(vec2 at, float spacing) {
    vec2 cell = at / spacing;
    vec2 wide = fwidth(cell);
    vec2 near = abs(fract(cell - 0.5) - 0.5) / max(wide, vec2(1e-6));
    vec2 fine = clamp(1.2 - 2.0 * wide, 0.0, 1.0);
    vec2 line = clamp(1.2 - near, 0.0, 1.0) * fine;
    return max(line.x, line.y);
}

// Light on a surface of a linear colour: sky above, the seabed's dim return below, sun with the ripples' play, a rim against the water.
vec3 lit(vec3 colour, vec3 n, vec3 view, float rim) {
    vec3 sky_light = mix(vec3(0.06, 0.12, 0.13), vec3(0.80, 0.88, 0.90), 0.5 + 0.5 * n.z);
    float sun = max(dot(n, SUN), 0.0) * (0.85 + 2.2 * ripples(world));
    float flat_angle = 1.0 - abs(dot(n, view));
    vec3 edge = rim * flat_angle * flat_angle * flat_angle * flat_angle * vec3(0.16, 0.34, 0.40);
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
    vec3 colour = mix(0.70, 1.0, dull) * linear_of(mark.rgb) * (1.0 + mix(0.22 * mottle, 0.45 * rough, dull));
    vec3 tilt = vec3(grain_at(own * 14.0 + 7.0), grain_at(own * 14.0 + 31.0), rough);
    vec3 m = normalize(n + mix(0.03, 0.20, dull) * tilt);
    vec3 mirrored = reflect(view, m);
    float glint = pow(max(dot(mirrored, SUN), 0.0), 40.0);
    float sheen = smoothstep(0.35, 0.95, mirrored.z) * (0.03 + 0.25 * pow(1.0 - abs(dot(m, view)), 3.0));
    vec3 gloss = (0.22 * glint * (0.5 + ripples(world)) + sheen) * vec3(0.75, 0.95, 1.0);
    return lit(colour, m, view, 0.30) + (1.0 - dull) * gloss * daylight(world.z);
}

// Laid rope: three strands that turn to the right, as far as they are wide enough to be seen. Its grain is the place along it and
// the direction round it.
vec3 rope(vec3 n, vec3 view) {
    const float LAY_M = 0.035;
    float turn = atan(own.z, own.y) / 6.2831853 - own.x / LAY_M;
    float seen = clamp(1.3 - 8.0 * fwidth(own.x) / LAY_M, 0.0, 1.0);
    float strands = mix(1.0, 0.80 + 0.20 * cos(3.0 * 6.2831853 * turn), seen);
    float round = 0.62 + 0.38 * abs(dot(n, view));
    if (FILM) {
        float glint = pow(max(dot(reflect(view, n), SUN), 0.0), 16.0);
        return lit(linear_of(tint.rgb) * strands * strands, n, view, 0.1) + 0.12 * glint * daylight(world.z);
    }
    return light_of(tint.rgb * strands * round * (0.94 + 0.10 * n.z));
}

// Height of the sand's ridges at a place [m]: crests a hand apart that wander and fork, on broad waves.
float sand_at(vec2 at) {
    float wander = grain_at(vec3(at * 0.35, 2.0)) + 0.4 * grain_at(vec3(at * 1.3, 5.0));
    float crest = 1.0 - abs(sin(11.0 * at.x + 4.0 * at.y + 5.0 * wander));
    return 0.012 * crest * (0.6 + 0.4 * grain_at(vec3(at * 0.8, 9.0))) + 0.06 * grain_at(vec3(at * 0.22, 0.0));
}

// Sand with patches, and lines to measure by; in a film also ridges and grains near by.
vec3 seabed(vec3 view, float far) {
    float fine = FILM ? exp(-far / 25.0) : 0.0;
    float patches = grain_at(world * vec3(0.13, 0.13, 0.0)) + 0.5 * exp(-far / 60.0) * grain_at(world * vec3(0.6, 0.6, 0.0));
    vec3 colour = linear_of(tint.rgb) * (1.0 + 0.30 * patches);
    vec3 n = vec3(0.0, 0.0, 1.0);
    if (fine > 0.02) {
        const float STEP_M = 0.02;
        float here = sand_at(world.xy);
        vec2 slope = vec2(sand_at(world.xy + vec2(STEP_M, 0.0)) - here, sand_at(world.xy + vec2(0.0, STEP_M)) - here) / STEP_M;
        n = normalize(vec3(-6.0 * fine * slope, 1.0));
        float speck = smoothstep(0.62, 0.75, grain_at(world * vec3(31.0, 31.0, 0.0)));
        colour *= 1.0 + fine * (0.35 * speck + 0.25 * grain_at(world * vec3(40.0, 40.0, 0.0)));
    }
    vec3 light = lit(1.1 * colour, n, view, 0.0);
    if (grid_m > 0.0) {
        light += max(0.20 * lines(world.xy, grid_m), 0.055 * lines(world.xy, grid_m * 0.1)) * vec3(0.25, 0.40, 0.42);
    }
    return light;
}

// Slope of the waves at a place of the surface: one octave, in a film three, the finer ones only near by.
vec2 wave_slope(float far) {
    vec2 slope = vec2(0.0);
    float scale = 0.35;
    float tall = 0.16;
    int octaves = FILM ? 3 : 1;
    for (int octave = 0; octave < octaves; octave++) {
        vec3 at = vec3(world.xy * scale + 7.0 * float(octave), 0.35 * time_s * sqrt(scale / 0.35));
        float share = tall * exp(-far * scale / 60.0);
        slope += share * vec2(grain_at(at), grain_at(at + vec3(31.0, 17.0, 0.0)));
        scale *= 2.7;
        tall *= 0.75;
    }
    return slope;
}

// The surface. From below: sky within the round window overhead, the deep mirrored beyond it; from above: a veil.
vec4 surface(vec3 view, float far, vec3 left) {
    const float INDEX = 1.34;
    float ruled = grid_m > 0.0 ? lines(world.xy, grid_m) : 0.0;
    vec3 n = normalize(vec3(wave_slope(far) * smoothstep(0.0, 0.4, abs(view.z)), 1.0));
    if (eye.z > 0.0) {
        float flat_angle = pow(1.0 - abs(view.z), 3.0);
        float glint = pow(max(dot(reflect(view, n), normalize(vec3(SUN.xy * 1.34, 0.8))), 0.0), 120.0);
        vec3 veil = mix(mix(light_of(tint.rgb), water_high, 0.7), sky, 0.15 + 0.7 * flat_angle) + 1.5 * glint;
        float thick = mix(0.10, 0.50, flat_angle) + 0.06 * ruled + 0.4 * glint;
        return vec4(veil, min(thick, 1.0) * emerged() * left.g);
    }
    float up = max(dot(view, n), 0.0);
    float inside = 1.0 - INDEX * INDEX * (1.0 - up * up);
    float open = smoothstep(-0.05, 0.12, inside);
    vec3 out_ray = vec3(INDEX * (view - up * n).xy, sqrt(max(inside, 0.0)));
    float sun = pow(max(dot(out_ray, normalize(vec3(SUN.xy * INDEX, 0.8))), 0.0), 24.0);
    vec3 through = mix(water_high, sky, 0.85) * (1.05 + 0.3 * up) + 1.6 * sun;
    vec3 mirrored = backdrop(reflect(view, n)) * 1.05;
    vec3 light = mix(mirrored, through, open) + 0.05 * ruled;
    return vec4(light, mix(0.80, 0.60, open) * left.g);
}

void main() {
    vec3 sight = world - eye;
    float far = length(sight);
    vec3 view = sight / far;
    vec3 n = normalize(outward);
    if (!gl_FrontFacing) { n = -n; }
    // Colours that are read against a scale are not changed by the water before what the camera looks at.
    vec3 clear = vec3(exp(-max(far - clear_m, 0.0) / hide_m));
    vec3 left = passed(far);
    if (LOOK == 3) {
        vec4 sheet = surface(view, far, left);
        shown = developed(sheet.rgb, sheet.a, gl_FragCoord.xy);
        return;
    }
    vec3 light;
    if (LOOK == 0) {
        light = lit(linear_of(tint.rgb), n, view, 0.16);
    } else if (LOOK == 1) {
        light = light_of(tint.rgb * (0.80 + 0.20 * abs(dot(n, view))));
        left = clear;
    } else if (LOOK == 2) {
        light = seabed(view, far);
    } else if (LOOK == 5) {
        light = rope(n, view);
        if (!FILM) { left = clear; }
    } else if (LOOK == 6) {
        light = light_of(vec3(0.03, 0.09, 0.13));
        left = clear;
    } else {
        light = skin(n, view);
    }
    if (eye.z > 0.0 && world.z < 0.0) {
        float way = far * world.z / (world.z - eye.z);
        light = mix(light, mix(water_low, water_high, 0.6), emerged() * sunk(way));
        left = clear;
    }
    shown = developed(mix(backdrop(view), light, left), 1.0, gl_FragCoord.xy);
}
