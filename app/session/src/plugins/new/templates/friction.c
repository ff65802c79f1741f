/* A law of friction: the rope sticks on a bristle of stiffness k up to mu N, then slips.
 *
 * y = P (z + s) is the trial bristle: z as the step began, s the slip since then, P = I - n n^T across the normal.
 * Stick: f = -k y, df/ds = -k P. Slip, with t = y/|y|: f = -mu N t, df/ds = -(mu N/|y|) (P - t t^T), df/dN = -mu t.
 */
#include "endline_plugin.h"

#include <math.h>

#define TEXT(words) { words, sizeof(words) - 1 }
#define FLOATS 3 /* kept by the program for each contact: the bristle */

typedef struct { double z[3], length, k, mu, most; } bristle_t;

static bristle_t bristle(const double *attributes, const endline_contacts_t *c, size_t i) {
    bristle_t b;
    const double *n = c->normal[i], *s = c->slip_m[i], *z = c->state + FLOATS * i;
    double up = 0.0, square = 0.0;
    for (int a = 0; a < 3; a++) up += (z[a] + s[a]) * n[a];
    for (int a = 0; a < 3; a++) b.z[a] = z[a] + s[a] - up * n[a], square += b.z[a] * b.z[a];
    b.length = sqrt(square);
    b.k = attributes[0] * c->length_m[i];
    b.mu = attributes[1] * c->coefficient[i];
    b.most = b.mu * c->normal_force_n[i];
    return b;
}

/* Asked several times a step: changes nothing. */
static int32_t respond(const void *context, const double *attributes, size_t attribute_count, const endline_contacts_t *c,
                       endline_friction_response_t *out, endline_message_t *message) {
    (void)context, (void)attribute_count, (void)message;
    for (size_t i = 0; i < c->count; i++) {
        const bristle_t b = bristle(attributes, c, i);
        const int sticks = b.k * b.length <= b.most;
        const double rate = sticks ? b.k : b.most / b.length, *n = c->normal[i];
        for (int a = 0; a < 3; a++) {
            const double t = sticks ? 0.0 : b.z[a] / b.length;
            out[i].force_n[a] = -rate * b.z[a];
            out[i].by_normal_force[a] = -b.mu * t;
            for (int d = 0; d < 3; d++) {
                const double u = sticks ? 0.0 : b.z[d] / b.length;
                out[i].by_slip[a][d] = -rate * ((a == d) - n[a] * n[d] - t * u);
            }
        }
    }
    return ENDLINE_STATUS_OK;
}

/* Asked once the step is accepted: the floats at its end. */
static int32_t advance(const void *context, const double *attributes, size_t attribute_count, const endline_contacts_t *c,
                       double *out, endline_message_t *message) {
    (void)context, (void)attribute_count, (void)message;
    for (size_t i = 0; i < c->count; i++) {
        const bristle_t b = bristle(attributes, c, i);
        const double share = b.k * b.length <= b.most ? 1.0 : b.most / (b.k * b.length);
        for (int a = 0; a < 3; a++) out[FLOATS * i + a] = share * b.z[a];
    }
    return ENDLINE_STATUS_OK;
}

static const endline_friction_t table = { .struct_size = sizeof table, .respond = respond, .advance = advance };

static const endline_attribute_t attributes[] = {
    { .key = TEXT("stiffness"), .unit = TEXT("N/m^2"), .help = TEXT("How stiffly skin holds rope, per metre of rope."),
      .kind = ENDLINE_ATTRIBUTE_NUMBER, .least = 1e4, .greatest = 1e10, .default_number = 1e7 },
    { .key = TEXT("scale"), .unit = TEXT("1"), .help = TEXT("Multiplies the coefficients of the gear library."),
      .kind = ENDLINE_ATTRIBUTE_NUMBER, .least = 0.0, .greatest = 3.0, .default_number = 1.0 },
};

static const endline_plugin_t plugin = {
    .struct_size = sizeof plugin, .kind = ENDLINE_KIND_FRICTION, .id = TEXT("@id@"), .version = TEXT("0.1.0"),
    .name = TEXT("@title@"), .help = TEXT("Sticks, then slips."),
    .attributes = attributes, .attribute_count = 2, .state_len = FLOATS, .table = &table,
};

@entry@
