/* A gear type: one trap, an endline of one rope, a buoy. */
#include "endline_plugin.h"

#include <string.h>

#define TEXT(words) { words, sizeof(words) - 1 }

static int32_t fail(endline_message_t *message, const char *words) {
    size_t length = strlen(words);
    if (length > message->capacity) length = message->capacity;
    memcpy(message->text, words, length);
    message->length = length;
    return ENDLINE_STATUS_ERROR;
}

/* Parts with a first guess of their places; the program finds their rest. */
static int32_t build(const void *context, const endline_value_t *values, size_t value_count, const endline_site_t *site,
                     const endline_rig_host_t *rig, endline_message_t *message) {
    (void)context, (void)value_count;
    if (site->depth_m < 2.0) return fail(message, "the water is too shallow");
    const endline_body_t trap = { TEXT("trap"), ENDLINE_BODY_TRAP, values[0].item, { 0.0, 0.0, -site->depth_m } };
    const endline_body_t buoy = { TEXT("buoy"), ENDLINE_BODY_BUOY, values[2].item, { 0.0, 0.0, 0.0 } };
    const endline_line_t line = {
        TEXT("endline"), values[1].item, { ENDLINE_AT_BODY, TEXT("trap") }, { ENDLINE_AT_BODY, TEXT("buoy") },
        values[3].number * site->depth_m,
    };
    const int bad = rig->add_body(rig->host, &trap) | rig->add_body(rig->host, &buoy) | rig->add_line(rig->host, &line);
    return bad ? fail(message, "the program did not take a part") : ENDLINE_STATUS_OK;
}

static const endline_gear_t table = { .struct_size = sizeof table, .build = build };

static const endline_attribute_t attributes[] = {
    { .key = TEXT("trap"), .help = TEXT("The trap."), .kind = ENDLINE_ATTRIBUTE_ITEM, .library = TEXT("traps"),
      .default_item = TEXT("wire-lobster-3ft") },
    { .key = TEXT("rope"), .help = TEXT("Rope of the endline."), .kind = ENDLINE_ATTRIBUTE_ITEM, .library = TEXT("ropes"),
      .default_item = TEXT("sink-3-8") },
    { .key = TEXT("buoy"), .help = TEXT("The buoy."), .kind = ENDLINE_ATTRIBUTE_ITEM, .library = TEXT("buoys"),
      .default_item = TEXT("bullet-6x14") },
    { .key = TEXT("scope"), .unit = TEXT("1"), .help = TEXT("Length of the endline as a multiple of water depth."),
      .kind = ENDLINE_ATTRIBUTE_NUMBER, .least = 1.0, .greatest = 5.0, .default_number = 1.4 },
};

static const endline_plugin_t plugin = {
    .struct_size = sizeof plugin, .kind = ENDLINE_KIND_GEAR, .id = TEXT("@id@"), .version = TEXT("0.1.0"),
    .name = TEXT("@title@"), .help = TEXT("One trap, one line, one buoy."),
    .attributes = attributes, .attribute_count = 4, .state_len = 0, .table = &table,
};

@entry@
