#!/bin/bash
# A plugin built anew while the window is open: real mouse and keys under Xvfb. The run before Reload and the run after it must
# differ, and each recording must replay only with the library that it names. Needs xvfb, xdotool, imagemagick and a C compiler.
#
#   tests/window/plugins.sh target/debug/endline [folder for pictures]
set -u
PROGRAM=$(realpath "${1:?the program to drive, such as target/debug/endline}")
PICTURES=${2:-$(mktemp -d)}
ROOT=$(cd "$(dirname "$0")/../.." && pwd)
WORK=$(mktemp -d)
FAILED=0
mkdir -p "$PICTURES" "$WORK/plugins" "$WORK/data"
cp -r "$ROOT/gear-library" "$WORK/library"
export XDG_DATA_HOME="$WORK/data" XDG_CACHE_HOME="$WORK/cache" ENDLINE_PLUGINS="$WORK/plugins" LIBGL_ALWAYS_SOFTWARE=1
SIZE=1280x720
. "$ROOT/tests/window/screen.sh"
trap 'kill $SCREEN 2>/dev/null; rm -rf "$WORK"' EXIT

picture() { import -window root "$PICTURES/$1.png"; }
keys() { xdotool key --delay 150 "$@"; sleep 1; }
typed() { xdotool type --delay 50 "$1"; sleep 1; }
command() { keys ctrl+p; sleep "${PATIENCE:-1}"; typed "$1"; sleep "${PATIENCE:-1}"; keys Return; sleep "$((${2:-1} * ${PATIENCE:-1}))"; }
check() { if eval "$2"; then echo "ok    $1"; else echo "WRONG $1"; FAILED=1; fi; }

# The plugin `speed.c` of the tests, built with a speed.
built() {
    sed "s/SPEED_M_S 1.0/SPEED_M_S $1/" "$ROOT/tests/plugins/speed.c" >"$WORK/speed.c"
    "${CC:-cc}" -std=c99 -shared -fPIC -I "$ROOT/plugins/sdk/include" -o "$WORK/plugins/libspeed.so" "$WORK/speed.c"
}
recordings() { ls "$WORK/data/endline/recordings/"*.endline 2>/dev/null | sort; }
# Replays a recording with the library as it is; what it says is kept.
replayed() { "$PROGRAM" --allow-plugins replay "$@" >/dev/null 2>"$WORK/said"; }

# The short scenario that the runs are of.
sed -e 's/org.endline.motion.swim/org.example.motion.speed/' -e '/^\[whale.attributes\]/,/^cruise_speed/d' -e 's/^duration.*/duration = "2 s"/' \
    "$ROOT/gear-library/scenarios/hello-endline.toml" >"$WORK/library/scenarios/speeds.toml"

built 1.0
"$PROGRAM" plugins allow "$WORK/plugins/libspeed.so" || exit 1
"$PROGRAM" --library "$WORK/library" >"$WORK/log" 2>&1 &
WINDOW=$!
for _ in $(seq 120); do
    sleep 0.5
    if ID=$(xdotool search --onlyvisible --name '^Endline$' 2>/dev/null); then break; fi
done
xdotool windowmove "$ID" 0 0 windowsize "$ID" 1280 720 windowfocus "$ID"
sleep "${SETTLE:-4}"

command "open speeds" 6
command "show plugins" 2
picture plugins-1-listed
command "speed as fast"
command "run or pause" "${RUN_S:-12}"
command "reset" 2
check "the first run was kept" "[ \$(recordings | wc -l) -eq 1 ]"

built 2.0
command "reload plugins" 4
picture plugins-2-asked
command "allow plugin" 6
picture plugins-3-reloaded
command "run or pause" "${RUN_S:-12}"
command "reset" 2
check "the second run was kept" "[ \$(recordings | wc -l) -eq 2 ]"
picture plugins-4-run-again
command "light" 2
picture plugins-5-light
kill "$WINDOW" 2>/dev/null; wait "$WINDOW" 2>/dev/null

FIRST=$(recordings | sed -n 1p); SECOND=$(recordings | sed -n 2p)
check "the run after Reload replays with the library as it is now, to the bit" "replayed '$SECOND' --verify"
"$PROGRAM" replay "$SECOND" --json 2>/dev/null >"$WORK/second.json"
check "the run before Reload is refused by the plugin's name" "! replayed '$FIRST' && grep -q 'org.example.motion.speed' '$WORK/said'"
built 1.0
check "and replays with the library that it names, allowed again" "\"$PROGRAM\" --allow-plugins replay '$FIRST' --json >'$WORK/first.json' 2>/dev/null"
hash_of() { grep -o '"state_hash":"[0-9a-f]*"' "$1"; }
check "the two runs differ" "[ -n \"\$(hash_of $WORK/first.json)\" ] && [ \"\$(hash_of $WORK/first.json)\" != \"\$(hash_of $WORK/second.json)\" ]"
check "the program said nothing bad" "! grep -qi 'panick' '$WORK/log'"
echo "pictures in $PICTURES"
exit $FAILED
