/* From here on the same for every plugin: what the program looks for when it opens the library. */
static const endline_plugin_t *const plugins[] = { &plugin };
static const endline_factory_t factory = {
    .struct_size = sizeof factory, .plugin_count = 1, .plugins = plugins,
    .about = TEXT("Who made this, and where its figures come from."),
};

static int32_t init(endline_text_t path, endline_message_t *message) {
    (void)path, (void)message;
    return ENDLINE_STATUS_OK;
}

static const void *get_factory(endline_text_t id) {
    const char wanted[] = ENDLINE_FACTORY_ID;
    if (id.length != sizeof wanted - 1) return NULL;
    for (size_t i = 0; i < id.length; i++)
        if (id.text[i] != wanted[i]) return NULL;
    return &factory;
}

const endline_entry_t endline_plugin_entry = {
    .abi_major = ENDLINE_ABI_MAJOR, .abi_minor = ENDLINE_ABI_MINOR, .struct_size = sizeof endline_plugin_entry,
    .init = init, .get_factory = get_factory,
};
