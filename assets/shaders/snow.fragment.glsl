// A particle in the water: a soft spot in the light of its depth.
in vec2 spot;
in float dense;
in float height;

out vec4 shown;

void main() {
    float soft = 1.0 - smoothstep(0.1, 1.0, length(spot));
    shown = developed(vec3(0.75, 0.85, 0.80) * daylight(height) + 0.4 * water_at(height), 0.5 * dense * soft, gl_FragCoord.xy);
}
