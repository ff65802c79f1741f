// Open water, lighter towards the surface and the sun, with shafts of light where the constant FILM is set; air above it.

in vec3 sight;

out vec4 shown;

// Light that rays of the sun scatter on the way to the eye, above the mean: the pattern of the surface along the line of sight.
float shafts(vec3 view) {
    const int STEPS = 12;
    const float LENGTH_M = 24.0;
    float noise = noise_of(gl_FragCoord.xy);
    float sum = 0.0;
    for (int step = 0; step < STEPS; step++) {
        float way = LENGTH_M * (float(step) + noise) / float(STEPS);
        vec3 at = eye + way * view;
        if (at.z < 0.0) {
            vec2 surface = at.xy - SUN.xy / SUN.z * at.z;
            sum += exp(at.z / 14.0 - way / 12.0) * (caustic(0.22 * surface) + 0.5 * caustic(0.6 * surface + 3.0) - 0.36);
        }
    }
    return sum / float(STEPS);
}

void main() {
    vec3 view = normalize(sight);
    vec3 light = backdrop(view);
    if (FILM && eye.z < 0.0) {
        float toward = 0.5 + 0.5 * dot(view, SUN);
        float above = smoothstep(-0.02, 0.30, view.z);  // where the seabed does not end against the water
        light *= max(1.0 + above * (4.0 + 10.0 * toward * toward) * shafts(view), 0.3);
    }
    shown = developed(light, 1.0, gl_FragCoord.xy);
}
