#!/bin/bash
# Each user's first hour in a real window: real mouse and keys under Xvfb, pictures of every step, checks of what it
# leaves on disk. Needs xvfb, xdotool and imagemagick.
#
#   tests/window/first_hours.sh target/debug/endline [folder for pictures]
#
# The window is 1280 x 720; places to click are those of the layout Design at that size.
set -u
PROGRAM=$(realpath "${1:?the program to drive, such as target/debug/endline}")
PICTURES=${2:-$(mktemp -d)}
ROOT=$(cd "$(dirname "$0")/../.." && pwd)
WORK=$(mktemp -d)
FAILED=0
mkdir -p "$PICTURES"
cp -r "$ROOT/gear-library" "$WORK/library"
export XDG_DATA_HOME="$WORK/data" LIBGL_ALWAYS_SOFTWARE=1
export DISPLAY=":$((100 + $$ % 500))"
Xvfb "$DISPLAY" -screen 0 1280x720x24 >/dev/null 2>&1 &
SCREEN=$!
trap 'kill $SCREEN 2>/dev/null; rm -rf "$WORK"' EXIT
sleep 1

opened() {
    "$PROGRAM" --library "$WORK/library" >"$WORK/log" 2>&1 &
    WINDOW=$!
    for _ in $(seq 120); do
        sleep 0.5
        if ID=$(xdotool search --onlyvisible --name '^Endline$' 2>/dev/null); then break; fi
    done
    xdotool windowmove "$ID" 0 0 windowsize "$ID" 1280 720 windowfocus "$ID"
    sleep "${SETTLE:-4}"
}
closed() { kill "$WINDOW" 2>/dev/null; wait "$WINDOW" 2>/dev/null; }
picture() { import -window root "$PICTURES/$1.png"; }
click() { xdotool mousemove "$1" "$2"; sleep 0.4; xdotool click 1; sleep "${3:-1}"; }
keys() { xdotool key --delay 150 "$@"; sleep 1; }
typed() { xdotool type --delay 50 "$1"; sleep 1; }
# Waits grow with PATIENCE, for machines that draw slowly.
command() { keys ctrl+p; sleep "${PATIENCE:-1}"; typed "$1"; sleep "${PATIENCE:-1}"; keys Return; sleep "$((${2:-1} * ${PATIENCE:-1}))"; }
check() { if eval "$2"; then echo "ok    $1"; else echo "WRONG $1"; FAILED=1; fi; }

designer() {
    opened
    picture designer-1-start
    command "layout design"
    command "show ropes library"
    command "show library"
    click 890 572; keys ctrl+a; typed "2,300 lbf"; keys Return
    picture designer-2-strength-typed
    command "save all"
    check "the strength is in its file, comments kept" \
        "grep -rq '2,300 lbf' '$WORK/library/ropes' && [ \$(grep -rl '# Hydrodynamic' '$WORK/library/ropes' | wc -l) -ge 20 ]"
    command "show assembly" 4
    picture designer-3-slack-and-running-tide
    command "show 3-d view"
    command "speed as fast"
    command "run or pause" 30
    picture designer-4-flown
    command "layout review" 4
    picture designer-5-peak-tension
}

regulator() {
    command "layout study" 4
    picture regulator-1-two-gears
    command "units noaa" 2
    picture regulator-2-trade-units
    command "size 150" 2
    picture regulator-3-projector
    command "size 100"
    command "light" 2
    picture regulator-4-light
    command "dark"
}

scientist() {
    command "open foraging-dive" 6
    command "layout fly" 3
    command "fly the whale" 2
    command "run or pause" 1
    xdotool keydown Up keydown w; sleep 3; xdotool keyup Up keyup w
    picture scientist-1-flown-by-hand
    keys Escape
    command "run or pause"
    command "reset" 3
    check "the flight was kept by itself" "ls '$WORK/data/endline/recordings/'*.endline >/dev/null 2>&1"
    command "show recordings" 2
    picture scientist-2-recordings
    command "show entanglement" 2
    picture scientist-3-entanglement
}

killed() {
    command "layout design"
    command "show library"
    click 890 602; keys ctrl+a; typed "1,234 lbf"; keys Return
    sleep 8
    kill -9 "$WINDOW"; wait "$WINDOW" 2>/dev/null
    check "no file was touched by edits that were not saved" "! grep -rq '1,234 lbf' '$WORK/library'"
    opened
    picture killed-1-offered-back
    check "the edits were kept" "grep -q '1,234 lbf' '$WORK/data/endline/'recovery-*.json"
}

designer
regulator
scientist
killed
closed
check "the program said nothing bad" "! grep -qi 'panick' '$WORK/log'"
echo "pictures in $PICTURES"
exit $FAILED
