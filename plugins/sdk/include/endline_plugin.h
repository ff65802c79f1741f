/* Endline's plugin ABI. Made from plugins/sdk/src/abi/table/; do not edit by hand:
 * ENDLINE_WRITE_HEADER=1 cargo test -p endline-tests --test plugins header
 *
 * A plugin library exports one constant of type endline_entry_t named endline_plugin_entry.
 * plugins/template-c/glide.c is a whole plugin; docs/plugin-abi.md has the rules.
 */

#ifndef ENDLINE_PLUGIN_H
#define ENDLINE_PLUGIN_H

#include <stddef.h>
#include <stdint.h>

// Id of the factory of this ABI.
#define ENDLINE_FACTORY_ID "endline.plugins/3"

// Spine joints from the skull (0) to the peduncle's end (`SPINE_JOINTS - 1`).
#define ENDLINE_SPINE_JOINTS 8

// Major version: another number means another layout.
#define ENDLINE_ABI_MAJOR 3

// Minor version: a greater number means fields added at the ends of structs, or kinds of attribute.
#define ENDLINE_ABI_MINOR 2

// Kind of plugin: whale motion, table `endline_motion_t`.
#define ENDLINE_KIND_MOTION 1

// Kind of plugin: friction model, table `endline_friction_t`.
#define ENDLINE_KIND_FRICTION 2

// Kind of plugin: gear type, table `endline_gear_t`.
#define ENDLINE_KIND_GEAR 3

// Status: done.
#define ENDLINE_STATUS_OK 0

// Status: could not be done; the message says why.
#define ENDLINE_STATUS_ERROR 1

// Status: the plugin failed inside (in Rust, panicked); the message has the known details.
#define ENDLINE_STATUS_CRASH 2

// Kind of attribute: a number in its SI unit.
#define ENDLINE_ATTRIBUTE_NUMBER 0

// Kind of attribute: the id of an item of the gear library.
#define ENDLINE_ATTRIBUTE_ITEM 1

// Kind of attribute: a whole number.
#define ENDLINE_ATTRIBUTE_COUNT 2

// Kind of attribute: one of several words.
#define ENDLINE_ATTRIBUTE_CHOICE 3

// Kind of body: trap.
#define ENDLINE_BODY_TRAP 0

// Kind of body: buoy.
#define ENDLINE_BODY_BUOY 1

// Kind of body: anchor.
#define ENDLINE_BODY_ANCHOR 2

// A line ends at a body.
#define ENDLINE_AT_BODY 0

// A line ends at a joint.
#define ENDLINE_AT_JOINT 1

// End A of a line, its `from` end.
#define ENDLINE_END_A 0

// End B of a line, its `to` end.
#define ENDLINE_END_B 1

// A labelled patch of skin: where a contact is, at the resolution of friction.
enum endline_region
#if __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // __STDC_VERSION__ >= 202311L
 {
  // Upper jaw's narrow top.
  ENDLINE_REGION_ROSTRUM = 0,
  // Baleen racks inside the mouth.
  ENDLINE_REGION_BALEEN = 1,
  // Arched lower lips.
  ENDLINE_REGION_LIPS = 2,
  // Rest of the head, chin included.
  ENDLINE_REGION_HEAD = 3,
  // Body between head and peduncle.
  ENDLINE_REGION_BODY = 4,
  // Tail stock.
  ENDLINE_REGION_PEDUNCLE = 5,
  // Blade of the left flipper away from its edges.
  ENDLINE_REGION_LEFT_FLIPPER = 6,
  // Leading edge of the left flipper.
  ENDLINE_REGION_LEFT_FLIPPER_LEADING = 7,
  // Trailing edge of the left flipper.
  ENDLINE_REGION_LEFT_FLIPPER_TRAILING = 8,
  // Tip of the left flipper.
  ENDLINE_REGION_LEFT_FLIPPER_TIP = 9,
  // Blade of the right flipper away from its edges.
  ENDLINE_REGION_RIGHT_FLIPPER = 10,
  // Leading edge of the right flipper.
  ENDLINE_REGION_RIGHT_FLIPPER_LEADING = 11,
  // Trailing edge of the right flipper.
  ENDLINE_REGION_RIGHT_FLIPPER_TRAILING = 12,
  // Tip of the right flipper.
  ENDLINE_REGION_RIGHT_FLIPPER_TIP = 13,
  // Left fluke away from its edges.
  ENDLINE_REGION_LEFT_FLUKE = 14,
  // Leading edge of the left fluke.
  ENDLINE_REGION_LEFT_FLUKE_LEADING = 15,
  // Trailing edge of the left fluke.
  ENDLINE_REGION_LEFT_FLUKE_TRAILING = 16,
  // Right fluke away from its edges.
  ENDLINE_REGION_RIGHT_FLUKE = 17,
  // Leading edge of the right fluke.
  ENDLINE_REGION_RIGHT_FLUKE_LEADING = 18,
  // Trailing edge of the right fluke.
  ENDLINE_REGION_RIGHT_FLUKE_TRAILING = 19,
};
#if __STDC_VERSION__ >= 202311L
typedef enum endline_region endline_region;
#else
typedef uint32_t endline_region;
#endif // __STDC_VERSION__ >= 202311L

// A part of the whale in reports: wraps and loads are counted for each.
enum endline_body_part
#if __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // __STDC_VERSION__ >= 202311L
 {
  // Head with the mouth.
  ENDLINE_BODY_PART_HEAD = 0,
  // Body between head and peduncle.
  ENDLINE_BODY_PART_BODY = 1,
  // Left flipper.
  ENDLINE_BODY_PART_LEFT_FLIPPER = 2,
  // Right flipper.
  ENDLINE_BODY_PART_RIGHT_FLIPPER = 3,
  // Tail stock.
  ENDLINE_BODY_PART_PEDUNCLE = 4,
  // Left fluke.
  ENDLINE_BODY_PART_LEFT_FLUKE = 5,
  // Right fluke.
  ENDLINE_BODY_PART_RIGHT_FLUKE = 6,
};
#if __STDC_VERSION__ >= 202311L
typedef enum endline_body_part endline_body_part;
#else
typedef uint32_t endline_body_part;
#endif // __STDC_VERSION__ >= 202311L

// Text: UTF-8, `length` bytes, not NUL-terminated; null means empty.
typedef struct {
  // First byte.
  const char *text;
  // Number of bytes.
  size_t length;
} endline_text_t;

// A buffer of the caller for a message; the callee writes UTF-8 and sets `length`.
typedef struct {
  // First byte of the buffer.
  char *text;
  // Size of the buffer in bytes.
  size_t capacity;
  // Bytes written.
  size_t length;
} endline_message_t;

// The entry that a plugin library exports as `endline_plugin_entry`.
typedef struct {
  // `ENDLINE_ABI_MAJOR` it was built for.
  uint32_t abi_major;
  // `ENDLINE_ABI_MINOR` it was built for.
  uint32_t abi_minor;
  // Size of this struct in bytes.
  uint32_t struct_size;
  // `[main-thread]` Called once, first, with the path of the library. Gives a status.
  int32_t (*init)(endline_text_t path, endline_message_t *message);
  // `[main-thread]` Called at most once, last; libraries stay mapped, so it may never be called. May be null.
  void (*deinit)(void);
  // `[main-thread]` The `endline_factory_t` for the id `endline.plugins/3`, null for any other id.
  const void *(*get_factory)(endline_text_t id);
} endline_entry_t;

// One setting of a plugin.
typedef struct {
  // Key in files.
  endline_text_t key;
  // SI unit, `1` for a pure number or a count; empty for an item or a word.
  endline_text_t unit;
  // Help shown beside the field.
  endline_text_t help;
  // `ENDLINE_ATTRIBUTE_NUMBER`, `ENDLINE_ATTRIBUTE_ITEM`, `ENDLINE_ATTRIBUTE_COUNT` or `ENDLINE_ATTRIBUTE_CHOICE`.
  uint32_t kind;
  // Number, count: least allowed value.
  double least;
  // Number, count: greatest allowed value.
  double greatest;
  // Number, count: default value.
  double default_number;
  // Item: folder of the library, such as `ropes`. Choice: the words, with `|` between.
  endline_text_t library;
  // Item: default id; empty for no item. Choice: default word.
  endline_text_t default_item;
} endline_attribute_t;

// An action of a whale motion on request.
typedef struct {
  // Id in files, such as `roll-away`.
  endline_text_t id;
  // Name shown in menus.
  endline_text_t name;
  // Help shown beside it.
  endline_text_t help;
} endline_act_t;

// A plugin: identity, attributes and functions; lives as long as the library.
typedef struct {
  // Size of this struct in bytes.
  uint32_t struct_size;
  // `ENDLINE_KIND_MOTION`, `ENDLINE_KIND_FRICTION` or `ENDLINE_KIND_GEAR`.
  uint32_t kind;
  // Reverse-domain id, such as `org.endline.friction.coulomb`.
  endline_text_t id;
  // Version of the plugin.
  endline_text_t version;
  // Name shown in menus.
  endline_text_t name;
  // One sentence of help.
  endline_text_t help;
  // Declared attributes, in the order of their values.
  const endline_attribute_t *attributes;
  // Number of attributes.
  size_t attribute_count;
  // Floats of state, stored by the engine: in total for a motion or gear type, for each contact for a friction model.
  size_t state_len;
  // First argument of every function of the table; owned by the plugin, may be null.
  const void *context;
  // `endline_motion_t`, `endline_friction_t` or `endline_gear_t`, as `kind` says.
  const void *table;
  // Acts of a whale motion, in the order of the control `act`; may be null for none.
  const endline_act_t *acts;
  // Number of acts.
  size_t act_count;
} endline_plugin_t;

// The plugins of a library; lives as long as the library.
typedef struct {
  // Size of this struct in bytes.
  uint32_t struct_size;
  // Number of plugins.
  uint32_t plugin_count;
  // A pointer to each.
  const endline_plugin_t *const *plugins;
  // Author of the library, and sources of its laws and figures. Since 3.1; may be null.
  endline_text_t about;
} endline_factory_t;

// The pilot's controls: one vocabulary for pad, keyboard, recording and pilot program.
typedef struct {
  // Swim speed, 0 (glide) to 1 (cruise).
  double speed;
  // Pitch, -1 (nose down) to 1 (nose up).
  double pitch;
  // Roll, -1 (to port) to 1 (to starboard).
  double roll;
  // Yaw, -1 (to starboard) to 1 (to port).
  double yaw;
  // Burst, 0 or 1: the greatest swimming speed.
  double burst;
  // Mouth, 0 (closed) to 1 (open).
  double mouth;
  // Flippers abducted (1) or adducted (-1).
  double flipper_raise;
  // Flippers pronated (1) or supinated (-1).
  double flipper_twist;
  // Flippers swept forward (1) or aft (-1).
  double flipper_sweep;
  // Requested act: 0 none, n the n-th that the motion declares; a whole number.
  double act;
} endline_controls_t;

// Input of a motion.
typedef struct {
  // Size of this struct in bytes.
  uint32_t struct_size;
  // Simulated time [s].
  double time_s;
  // Length of the step [s].
  double dt_s;
  // Body length, snout to fluke notch [m].
  double length_m;
  // Speed through the water along the whale's x axis [m/s].
  double speed_m_s;
  // Position of the whale frame's origin, mid-body [m].
  double position_m[3];
  // Orientation as a quaternion (x, y, z, w), whale frame to world.
  double orientation[4];
  // The pilot's controls.
  endline_controls_t controls;
  // Normal contact force on each body part in the last step [N].
  const double *contact_force_n;
  // Number of body parts.
  size_t body_part_count;
  // Mean place of those forces on each part: distance to port from the midplane on the body at rest [m].
  const double *contact_port_m;
  // Speed at which the drag of the body equals the thrust of the last step, if `has_thrust` [m/s]. Since 3.2.
  double thrust_speed_m_s;
  // 1 for a kinetic whale; 0 for a kinematic one, which has no thrust. Since 3.2.
  uint32_t has_thrust;
} endline_motion_input_t;

// Joint angles of a whale [rad]; all zero is the rest posture.
//
// The section at mid-body is fixed to the whale's frame: joints ahead of it move the head,
// joints aft of it the tail. The documentation of each field states its sign.
//
// Index 0 of a pair is the left (port) side, 1 the right.
typedef struct {
  // Each spine joint about the whale's y axis; positive bends the part aft of it down.
  double spine_pitch[ENDLINE_SPINE_JOINTS];
  // Each spine joint about the whale's z axis; positive swings the part aft of it to starboard.
  double spine_yaw[ENDLINE_SPINE_JOINTS];
  // Each spine joint about the whale's x axis (torsion); positive turns the part aft of it starboard side down.
  double spine_roll[ENDLINE_SPINE_JOINTS];
  // Flukes against the peduncle about y; positive turns the trailing edge down.
  double fluke_pitch;
  // Bend of each fluke blade; positive lifts the tip.
  double fluke_flex[2];
  // Flipper swept aft about the dorsal axis; 0 at rest, positive aft, negative forward.
  double flipper_sweep[2];
  // Flipper raised (abducted) away from the body; positive lifts the tip.
  double flipper_raise[2];
  // Flipper twisted about its long axis; positive pronates (leading edge down).
  double flipper_twist[2];
  // Flipper blade bent; positive lifts the tip.
  double flipper_flex[2];
  // Jaw drop; 0 closed, positive open.
  double jaw;
  // Lower lips turned out; 0 closed against the rostrum, positive open.
  double lips[2];
} endline_posture_t;

// Output of a motion.
typedef struct {
  // Speed through the water at the end of the step [m/s].
  double speed_m_s;
  // Turn rates about the whale's own x (roll), y (pitch down) and z (yaw to port) axes [rad/s].
  double turn_rate_rad_s[3];
  // Joint angles at the end of the step.
  endline_posture_t posture;
} endline_motion_output_t;

// Functions of a whale motion.
typedef struct {
  // Size of this struct in bytes.
  uint32_t struct_size;
  // `[any-thread]` Moves the whale over one step; may advance `state`.
  int32_t (*step)(const void *context,
                  const double *attributes,
                  size_t attribute_count,
                  const endline_motion_input_t *input,
                  double *state,
                  size_t state_len,
                  endline_motion_output_t *out,
                  endline_message_t *message);
} endline_motion_t;

// All contacts of one solver pass: arrays of `count` entries, vectors in the world frame.
typedef struct {
  // Size of this struct in bytes.
  uint32_t struct_size;
  // Number of contacts.
  size_t count;
  // Length of the step [s].
  double dt_s;
  // Normal force, never negative [N].
  const double *normal_force_n;
  // Unit normal, from skin to rope.
  const double (*normal)[3];
  // Unit vector fixed to the skin, across the normal: athwart the whale at rest; on baleen along the plates.
  const double (*grain)[3];
  // Unit vector along the rope; for a contact of a trap, buoy or anchor: the normal.
  const double (*along)[3];
  // Tangential displacement of rope against skin since the start of the step [m].
  const double (*slip_m)[3];
  // Length of rope of each contact [m].
  const double *length_m;
  // Coefficient of friction.
  const double *coefficient;
  // Number of the skin region.
  const uint32_t *region;
  // Index of the rope material; for a contact of a trap, buoy or anchor: 4294967295.
  const uint32_t *rope;
  // Floats at the start of the step, `state_len` for each contact.
  const double *state;
  // Floats for each contact.
  size_t state_len;
} endline_contacts_t;

// Response of a friction model for one contact.
typedef struct {
  // Force of skin on rope, in the plane across the normal [N].
  double force_n[3];
  // Its derivative by slip, row by row: `d force[i] / d slip[j]` [N/m].
  double by_slip[3][3];
  // Its derivative by the normal force [1].
  double by_normal_force[3];
} endline_friction_response_t;

// Functions of a friction model.
typedef struct {
  // Size of this struct in bytes.
  uint32_t struct_size;
  // `[any-thread]` Forces and derivatives: writes `contacts.count` answers. Called many times per step.
  int32_t (*respond)(const void *context,
                     const double *attributes,
                     size_t attribute_count,
                     const endline_contacts_t *contacts,
                     endline_friction_response_t *out,
                     endline_message_t *message);
  // `[any-thread]` Floats at the end of an accepted step: writes `contacts.count * state_len`.
  int32_t (*advance)(const void *context,
                     const double *attributes,
                     size_t attribute_count,
                     const endline_contacts_t *contacts,
                     double *out,
                     endline_message_t *message);
} endline_friction_t;

// The value of an attribute.
typedef struct {
  // Kind of the attribute, as declared.
  uint32_t kind;
  // The number or count.
  double number;
  // The id of the item, or the word.
  endline_text_t item;
} endline_value_t;

// The site of a rig.
typedef struct {
  // Water depth [m].
  double depth_m;
  // Surface current, east and north [m/s].
  double current_m_s[2];
} endline_site_t;

// A trap, buoy or anchor of a rig.
typedef struct {
  // Id within the rig.
  endline_text_t id;
  // `ENDLINE_BODY_TRAP`, `ENDLINE_BODY_BUOY` or `ENDLINE_BODY_ANCHOR`.
  uint32_t kind;
  // Id of the library item.
  endline_text_t item;
  // Initial place [m].
  double position_m[3];
} endline_body_t;

// A splice.
typedef struct {
  // Id within the rig.
  endline_text_t id;
  // Initial place [m].
  double position_m[3];
} endline_joint_t;

// An end of a line.
typedef struct {
  // `ENDLINE_AT_BODY` or `ENDLINE_AT_JOINT`.
  uint32_t at;
  // Id of the body or joint.
  endline_text_t id;
} endline_rig_end_t;

// A length of one rope between two ends.
typedef struct {
  // Id within the rig.
  endline_text_t id;
  // Id of the rope in the library.
  endline_text_t rope;
  // End A.
  endline_rig_end_t from;
  // End B.
  endline_rig_end_t to;
  // Unstretched length [m].
  double length_m;
} endline_line_t;

// A weak link at one end of a line.
typedef struct {
  // Id within the rig.
  endline_text_t id;
  // Id of the weak link in the library.
  endline_text_t item;
  // Id of its line.
  endline_text_t line;
  // `ENDLINE_END_A` or `ENDLINE_END_B`.
  uint32_t end;
} endline_link_t;

// The program's functions by which a gear type builds; each takes `host` first and gives a status.
typedef struct {
  // Size of this struct in bytes.
  uint32_t struct_size;
  // First argument of each function.
  void *host;
  // Adds a trap, buoy or anchor.
  int32_t (*add_body)(void *host, const endline_body_t *body);
  // Adds a splice.
  int32_t (*add_joint)(void *host, const endline_joint_t *joint);
  // Adds a line.
  int32_t (*add_line)(void *host, const endline_line_t *line);
  // Adds a weak link.
  int32_t (*add_link)(void *host, const endline_link_t *link);
  // Sets the initial path of a line added before, `count` places from end A to end B [m].
  int32_t (*lay_line)(void *host, endline_text_t line, const double (*places_m)[3], size_t count);
} endline_rig_host_t;

// Input of a gear type, once per step.
typedef struct {
  // Size of this struct in bytes.
  uint32_t struct_size;
  // Simulated time [s].
  double time_s;
  // Length of the step [s].
  double dt_s;
  // Number of lines of its rig.
  size_t line_count;
  // Tension of each line, in the order built, at end A then end B [N].
  const double (*end_tension_n)[2];
} endline_gear_step_t;

// The program's functions by which a gear type acts; indices are in the order built.
typedef struct {
  // Size of this struct in bytes.
  uint32_t struct_size;
  // First argument of each function.
  void *host;
  // Cuts a line at `ENDLINE_END_A` or `ENDLINE_END_B`.
  int32_t (*cut_line)(void *host, uint32_t line, uint32_t end);
  // Opens a weak link or release.
  int32_t (*release_link)(void *host, uint32_t link);
} endline_action_host_t;

// Functions of a gear type.
typedef struct {
  // Size of this struct in bytes.
  uint32_t struct_size;
  // `[any-thread]` Builds the rig by calling `rig`'s functions.
  int32_t (*build)(const void *context,
                   const endline_value_t *values,
                   size_t value_count,
                   const endline_site_t *site,
                   const endline_rig_host_t *rig,
                   endline_message_t *message);
  // `[any-thread]` Once a step; acts by calling `actions`' functions. Null where the gear never acts.
  int32_t (*step)(const void *context,
                  const endline_value_t *values,
                  size_t value_count,
                  const endline_gear_step_t *input,
                  double *state,
                  size_t state_len,
                  const endline_action_host_t *actions,
                  endline_message_t *message);
} endline_gear_t;

#endif  /* ENDLINE_PLUGIN_H */

/* Define this in the plugin: the program loads this symbol. */
#ifdef __cplusplus
extern "C"
#endif
#ifdef _WIN32
__declspec(dllexport)
#endif
extern const endline_entry_t endline_plugin_entry;
