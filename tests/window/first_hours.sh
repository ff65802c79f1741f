#!/bin/bash
# Each user's first hour in a real window: real mouse and keys under Xvfb, pictures of every step, checks of what it
# leaves on disk. Needs xvfb, xdotool and imagemagick; ends with a line for each check and fails where one does.
#
#   tests/window/first_hours.sh target/debug/endline [folder for pictures]
#
# The window is 1280 x 720; places to click are those of the layout Design at that size. PATIENCE stretches every pause,
# for machines that draw slowly: it is found by how long the window takes to open.
set -u
PROGRAM=$(realpath "${1:?the program to drive, such as target/debug/endline}")
PICTURES=${2:-$(mktemp -d)}
ROOT=$(cd "$(dirname "$0")/../.." && pwd)
WORK=$(mktemp -d)
FAILED=0
mkdir -p "$PICTURES"
cp -r "$ROOT/gear-library" "$WORK/library"
# The encounter's first twenty seconds are enough: the whale meets the rope at fifteen.
sed -i 's/^duration = .*/duration = "20 s"/' "$WORK/library/scenarios/hello-endline.toml"
export XDG_DATA_HOME="$WORK/data" LIBGL_ALWAYS_SOFTWARE=1
DATA="$WORK/data/endline"
export DISPLAY=":$((100 + $$ % 500))"
Xvfb "$DISPLAY" -screen 0 1280x720x24 >/dev/null 2>&1 &
SCREEN=$!
WINDOW=
trap 'kill $WINDOW $SCREEN 2>/dev/null; rm -rf "$WORK"' EXIT
sleep 1

# A study small enough for an hour's first minutes: two ratings, four encounters.
cat >"$WORK/library/studies/first-hour.toml" <<'STUDY'
format = 1
kind = "study"
name = "Two ratings"
scenario = "hello-weak-link"
encounters = 4
baseline = "none"

[run]
passed = "4 s"
held = "2 s"

[[option]]
id = "none"
name = "No weak link"

[option.set]
weak_links = false
duration = "4 s"

[[option]]
id = "link-0600"
name = "600 lbf"

[option.set]
duration = "4 s"
"link.0.rating" = "600 lbf"

[encounter.speed]
uniform = ["0.8 m/s", "1.4 m/s"]
source = "assumed"
STUDY

pause() { sleep "$(awk "BEGIN { print ${1:-1} * ${PATIENCE:-1} }")"; }
opened() {
    local begun=$SECONDS
    "$PROGRAM" --library "$WORK/library" >>"$WORK/log" 2>&1 &
    WINDOW=$!
    for _ in $(seq 240); do
        sleep 0.25
        if ID=$(xdotool search --onlyvisible --name '^Endline$' 2>/dev/null); then break; fi
    done
    if [ -z "$ID" ]; then echo "WRONG no window: $(tail -3 "$WORK/log")"; exit 1; fi
    PATIENCE=${PATIENCE:-$(( (SECONDS - begun) / 4 + 1 ))}
    xdotool windowmove "$ID" 0 0 windowsize "$ID" 1280 720 windowfocus "$ID"
    pause 3
}
picture() { import -window root "$PICTURES/$1.png"; }
click() { xdotool mousemove "$1" "$2"; pause 0.4; xdotool click 1; pause 0.5; }
keys() { xdotool key --delay 100 "$@"; pause 0.4; }
typed() { xdotool type --delay 30 "$1"; pause 0.4; }
# By its name in the palette, then so long.
command() { keys ctrl+p; typed "$1"; keys Return; pause "${2:-0.5}"; }
check() { if eval "$2"; then echo "ok    $1"; else echo "WRONG $1"; FAILED=1; picture "wrong-$(echo "$1" | tr -c 'a-z\n' -)"; fi; }
# Waits until something is so, at most so many seconds.
within() { local end=$((SECONDS + $1)); until eval "$2"; do [ $SECONDS -lt $end ] || return 1; sleep 0.5; done; }

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
    command "show assembly" 3
    picture designer-3-slack-and-running-tide
    command "show 3-d view"
    command "speed as fast"
    command "run or pause"
    check "the run ends and is kept by itself" "within 240 \"ls '$DATA'/recordings/*.endline >/dev/null 2>&1\""
    picture designer-4-flown
    command "layout review" 2
    picture designer-5-peak-tension
}

regulator() {
    command "layout study"
    command "open study first-hour" 2
    picture regulator-1-study
    command "run the study"
    check "the study runs to its report" "within 300 \"ls '$DATA'/studies/first-hour-*/report.html >/dev/null 2>&1\""
    pause 2
    picture regulator-2-rates
    check "every option met the same four encounters" "[ \$(cat '$DATA'/studies/first-hour-*/table.csv | wc -l) -eq 9 ]"
    command "size 150"
    picture regulator-3-projector
    command "size 100"
    command "light"
    picture regulator-4-light
    command "dark"
}

scientist() {
    local before
    before=$(ls "$DATA/recordings" | wc -l)
    command "open foraging-dive" 4
    command "layout fly" 2
    command "fly the whale"
    command "run or pause"
    xdotool keydown Up keydown w; sleep 3; xdotool keyup Up keyup w
    picture scientist-1-flown-by-hand
    keys Escape
    command "run or pause"
    command "reset" 2
    check "the flight was kept by itself" "[ \$(ls '$DATA/recordings' | wc -l) -gt $before ]"
    command "show recordings"
    picture scientist-2-recordings
    command "show entanglement"
    picture scientist-3-entanglement
    command "open hello-endline" 6
    command "speed as fast"
    command "run or pause" 8
    command "run or pause"
    command "first moment"
    command "one moment on"
    command "edit the inputs" 3
    command "show pilot program" 2
    picture scientist-4-inputs-as-a-program
    command "add an entry"
    command "rerun from the moment" 8
    command "hold this run" 6
    command "run or pause" 8
    command "run or pause"
    picture scientist-5-two-runs-compared
    command "end the comparison"
    command "views at once: 4" 3
    command "read buoy" 2
    picture scientist-6-four-views-and-a-reading
    command "views at once: 1"
    command "let go of what is read"
}

# Killed amid edits: nothing on disk is touched, and the edits are offered back.
killed() {
    command "layout design"
    command "show library"
    click 890 602; keys ctrl+a; typed "1,234 lbf"; keys Return
    within 60 "grep -q '1,234 lbf' '$DATA/'recovery-*.json 2>/dev/null"
    kill -9 "$WINDOW"; wait "$WINDOW" 2>/dev/null
    check "no file was touched by edits that were not saved" "! grep -rq '1,234 lbf' '$WORK/library'"
    opened
    picture killed-1-offered-back
    check "the edits were kept" "grep -q '1,234 lbf' '$DATA/'recovery-*.json"
}

# What was chosen is kept while the window is open, for the next time.
chosen() {
    command "units noaa"
    # A window that has nothing to draw does not save itself.
    local nudge="xdotool mousemove_relative 3 0; xdotool mousemove_relative -- -3 0"
    check "units chosen are kept" "within 60 \"$nudge; grep -qs 'Noaa' '$DATA'/*.ron\""
}

designer
regulator
scientist
killed
chosen
check "the program said nothing bad" "! grep -qi 'panick' '$WORK/log'"
echo "pictures in $PICTURES, $SECONDS s"
exit $FAILED
