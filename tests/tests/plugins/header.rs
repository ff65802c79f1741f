//! The C header is what the Rust source of the table says.

use std::fs;

use cbindgen::{Builder, Config, DocumentationStyle, ItemType, Language, RenameRule, Style};
use endline_sdk::abi::table::FACTORY_ID;
use endline_tests::root;

const HEADER: &str = "plugins/sdk/include/endline_plugin.h";

const PREAMBLE: &str = "\
/* Endline's plugin ABI. Made from plugins/sdk/src/abi/table/; do not edit by hand:
 * ENDLINE_WRITE_HEADER=1 cargo test -p endline-tests --test plugins header
 *
 * A plugin library exports one constant of type endline_entry_t named endline_plugin_entry.
 * plugins/template-c/glide.c is a whole plugin; docs/plugin-abi.md has the rules.
 */";

/// After the last struct: the one thing a plugin defines.
const TRAILER: &str = "\
/* Define this in the plugin: the program loads this symbol. */
#ifdef __cplusplus
extern \"C\"
#endif
#ifdef _WIN32
__declspec(dllexport)
#endif
extern const endline_entry_t endline_plugin_entry;";

/// Rust name and C name of each type.
const TYPES: [(&str, &str); 28] = [
    ("AbiText", "endline_text_t"),
    ("AbiMessage", "endline_message_t"),
    ("AbiEntry", "endline_entry_t"),
    ("AbiFactory", "endline_factory_t"),
    ("AbiPlugin", "endline_plugin_t"),
    ("AbiAttribute", "endline_attribute_t"),
    ("AbiAct", "endline_act_t"),
    ("AbiMotion", "endline_motion_t"),
    ("AbiMotionInput", "endline_motion_input_t"),
    ("Controls", "endline_controls_t"),
    ("MotionOutput", "endline_motion_output_t"),
    ("Posture", "endline_posture_t"),
    ("AbiFriction", "endline_friction_t"),
    ("AbiContacts", "endline_contacts_t"),
    ("FrictionResponse", "endline_friction_response_t"),
    ("AbiGear", "endline_gear_t"),
    ("AbiValue", "endline_value_t"),
    ("Site", "endline_site_t"),
    ("AbiGearStep", "endline_gear_step_t"),
    ("AbiRigHost", "endline_rig_host_t"),
    ("AbiActionHost", "endline_action_host_t"),
    ("AbiBody", "endline_body_t"),
    ("AbiJoint", "endline_joint_t"),
    ("AbiRigEnd", "endline_rig_end_t"),
    ("AbiLine", "endline_line_t"),
    ("AbiLink", "endline_link_t"),
    ("Region", "endline_region"),
    ("BodyPart", "endline_body_part"),
];

/// Constants; in C each begins with `ENDLINE_`.
const CONSTANTS: [&str; 20] = [
    "ABI_MAJOR",
    "ABI_MINOR",
    "KIND_MOTION",
    "KIND_FRICTION",
    "KIND_GEAR",
    "STATUS_OK",
    "STATUS_ERROR",
    "STATUS_CRASH",
    "ATTRIBUTE_NUMBER",
    "ATTRIBUTE_ITEM",
    "ATTRIBUTE_COUNT",
    "ATTRIBUTE_CHOICE",
    "BODY_TRAP",
    "BODY_BUOY",
    "BODY_ANCHOR",
    "AT_BODY",
    "AT_JOINT",
    "END_A",
    "END_B",
    "SPINE_JOINTS",
];

/// Rust name and C name of all that is exported.
fn names() -> impl Iterator<Item = (String, String)> {
    let types = TYPES.iter().map(|(rust, c)| ((*rust).to_owned(), (*c).to_owned()));
    types.chain(CONSTANTS.iter().map(|name| ((*name).to_owned(), format!("ENDLINE_{name}"))))
}

fn config() -> Config {
    let mut config =
        Config { language: Language::C, style: Style::Type, line_length: 110, ..Config::default() };
    config.header = Some(PREAMBLE.to_owned());
    config.trailer = Some(TRAILER.to_owned());
    config.include_guard = Some("ENDLINE_PLUGIN_H".to_owned());
    config.no_includes = true;
    config.sys_includes = vec!["stddef.h".to_owned(), "stdint.h".to_owned()];
    config.after_includes = Some(format!(
        "\n// Id of the factory of this ABI.\n#define ENDLINE_FACTORY_ID \"{FACTORY_ID}\""
    ));
    config.usize_is_size_t = true;
    config.documentation_style = DocumentationStyle::C99;
    config.enumeration.rename_variants = RenameRule::QualifiedScreamingSnakeCase;
    config.export.item_types = vec![ItemType::Structs, ItemType::Enums, ItemType::Constants];
    config.export.include = TYPES.iter().map(|(rust, _)| (*rust).to_owned()).collect();
    config.export.exclude = ["FLUKE_STATION", "SPINE_STATIONS"].map(str::to_owned).to_vec();
    config.export.rename = names().collect();
    config
}

fn generated() -> String {
    let mut builder = Builder::new().with_config(config());
    let hooks = ["whale/posture.rs", "whale/skin.rs", "motion.rs", "friction.rs", "gear.rs"];
    let tables =
        ["mod.rs", "motion.rs", "friction.rs", "gear.rs"].map(|file| format!("abi/table/{file}"));
    for file in hooks.iter().copied().chain(tables.iter().map(String::as_str)) {
        builder = builder.with_src(root().join("plugins/sdk/src").join(file));
    }
    let mut bytes = Vec::new();
    builder.generate().unwrap().write(&mut bytes);
    let text = String::from_utf8(bytes).unwrap();
    // Lists of enum values have no meaning in C.
    let text =
        text.split("\n\n").filter(|part| !part.contains("_ALL {")).collect::<Vec<_>>().join("\n\n");
    names().fold(text, |text, (rust, c)| text.replace(&format!("[`{rust}`]"), &format!("`{c}`")))
}

#[test]
fn header_is_up_to_date() {
    let (path, fresh) = (root().join(HEADER), generated());
    if std::env::var_os("ENDLINE_WRITE_HEADER").is_some() {
        fs::write(&path, &fresh).unwrap();
    }
    let committed = fs::read_to_string(&path).unwrap_or_default();
    let first = committed.lines().zip(fresh.lines()).position(|(a, b)| a != b);
    assert_eq!(
        committed, fresh,
        "{HEADER} is out of date from line {first:?}; its head says how to write it anew"
    );
}
