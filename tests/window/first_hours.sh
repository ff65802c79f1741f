#!/bin/bash
# Each user's first hour in a real window: real mouse and keys under Xvfb, pictures of every step, checks of what it
# leaves on disk. Needs xvfb, xdotool and imagemagick; ends with a line for each check and fails where one does.
#
#   tests/window/first_hours.sh target/debug/endline [folder for pictures]
#
# Places to click are those of the layout Design at 1280 x 720.
set -u
PROGRAM=$(realpath "${1:?the program to drive, such as target/debug/endline}")
PICTURES=${2:-$(mktemp -d)}
SIZE=1280x720
. "$(dirname "$0")/lib.sh"
SCENARIOS="$WORK/library/scenarios"
# The encounter's first seconds are enough, with rope no finer than a picture of it needs: the whale meets the rope at thirteen.
sed -i 's/^duration = .*/duration = "20 s"/; s/^rope_nodes = .*/rope_nodes = 200/' "$SCENARIOS/hello-endline.toml"
sed -i 's/^rope_nodes = .*/rope_nodes = 100/' "$SCENARIOS/hello-weak-link.toml"

# A study small enough for an hour's first minutes: two ratings, four encounters.
cat >"$WORK/library/studies/first-hour.toml" <<'STUDY'
format = 1
kind = "study"
name = "Two ratings"
scenario = "hello-weak-link"
encounters = 4
baseline = "none"

[run]
passed = "2 s"
held = "1 s"

[[option]]
id = "none"
name = "No weak link"

[option.set]
weak_links = false
duration = "2 s"

[[option]]
id = "link-0600"
name = "600 lbf"

[option.set]
duration = "2 s"
"link.0.rating" = "600 lbf"

[encounter.speed]
uniform = ["0.8 m/s", "1.4 m/s"]
source = "assumed"
STUDY

runs_kept() { ls "$DATA/recordings" 2>/dev/null | grep -c 'endline$'; }
kept() { [ "$(runs_kept)" -ge "$1" ]; }
# Runs, and waits until so many runs are kept.
flown() {
    command "run or pause"
    within 300 "kept $1" 0.3
}
# A cell of the first rope of the table, typed anew.
strength() { click 860 "$1"; keys ctrl+a; typed "$2"; keys Return; still 5; }

# The designer's task list: edit a rope, put inserts every 60 ft into the top 75 % of the endline, compare slack and running tide, fly, find the peak tension.
designer() {
    opened
    picture designer-1-start
    command "layout design"
    command "show library"
    strength 572 "2,300 lbf"
    picture designer-2-strength-typed
    command "show assembly"
    still 20
    picture designer-3-slack-and-running-tide
    click 411 260
    picture designer-4-inserts-put-in
    command "save all"
    check "the strength is in its file, comments kept" \
        "grep -rq '2,300 lbf' '$WORK/library/ropes' && [ \$(grep -rl '# Hydrodynamic' '$WORK/library/ropes' | wc -l) -ge 20 ]"
    check "the strength has lost the source of the old one" \
        "grep -rq '2,300 lbf.*typed by hand, without a source' '$WORK/library/ropes'"
    check "inserts are in both lines of the endline, all else as it was" \
        "[ \$(grep -c 'weak-1700-3-8' '$WORK/library/assemblies/single-mine.toml') -eq 2 ] && grep -q 'lower_share = 0.3333333333333333' '$WORK/library/assemblies/single-mine.toml'"
    check "the assembly that came with the program is as it was" "! grep -q 'weak-1700-3-8' '$WORK/library/assemblies/single.toml'"
    command "show 3-d view"
    command "speed as fast"
    check "the run ends and is kept by itself" "flown 1"
    picture designer-5-flown
    command "layout review"
    picture designer-6-peak-tension
    command "show entanglement"
    picture designer-7-wraps
}

# A click that is counted.
CLICKS=0
press() { click "$1" "$2"; CLICKS=$((CLICKS + 1)); }

# From a shipped trawl to its compliance sheet, by mouse alone but for what is typed.
hearing() {
    press 948 15                                            # the layout Design
    press 555 44; still 20                                  # the panel Rules
    press 360 76                                            # gear; the list is wheeled to its end
    xdotool mousemove 420 200; for _ in $(seq 20); do xdotool click 5; sleep 0.05; done; still 5
    press 353 175; still 20                                 # Ten-trap trawl, nearshore
    press 573 76                                            # area
    press 540 240; still 20                                 # Maine lobster zone B
    press 468 104; typed "5 nmi"; keys Return; still 10     # distance from shore
    press 580 104; keys ctrl+a; typed "30 fathom"; keys Return; still 20 # depth
    picture regulator-0-rules
    press 325 168                                           # Compliance sheet
    check "the trawl's sheet is written" "within 120 \"ls '$DATA'/studies/sheets/trawl-10-me-b-*.html >/dev/null 2>&1\""
    check "from the trawl to its sheet in at most 15 clicks: $CLICKS" "[ $CLICKS -le 15 ]"
}

regulator() {
    hearing
    command "layout study"
    command "open study first-hour"
    picture regulator-1-study
    command "run the study"
    check "the study runs to its report" "within 300 \"ls '$DATA'/studies/first-hour-*/report.html >/dev/null 2>&1\""
    picture regulator-2-rates 20
    check "every option met the same four encounters" "[ \$(cat '$DATA'/studies/first-hour-*/table.csv | wc -l) -eq 9 ]"
    command "save the study's bundle"
    path "$WORK"
    check "the bundle is saved where a path was typed" "within 60 \"[ -s '$WORK/first-hour/bundle/study.toml' ]\""
    command "open hello-weak-link"
    still 20
    command "weak links on or off"
    command "add an option from unsaved edits"
    command "save all"
    check "the design is an option of the study, and the scenario as it was" \
        "grep -q 'id = \"design\"' '$WORK/library/studies/first-hour.toml' && ! grep -q '^weak_links = false' '$SCENARIOS/hello-weak-link.toml'"
    picture regulator-2b-an-option-more
    command "size 150"
    picture regulator-3-projector
    command "size 100"
    command "light"
    picture regulator-4-light
    command "dark"
}

scientist() {
    local before
    before=$(runs_kept)
    command "open foraging-dive"
    command "layout fly"
    still 20
    command "fly the whale"
    command "speed 1"
    command "run or pause"
    xdotool keydown Up keydown w; sleep 2; xdotool keyup Up keyup w
    import -window root "$PICTURES/scientist-1-flown-by-hand.png"
    keys Escape
    command "run or pause"
    command "reset"
    check "the flight was kept by itself" "within 20 'kept $((before + 1))'"
    command "show 3-d view"
    command "save a picture of the view"
    path "$WORK/view.png"
    check "the view is saved as a picture" "within 60 \"[ -s '$WORK/view.png' ]\""
    command "show recordings"
    picture scientist-2-recordings
    command "open hello-endline"
    still 20
    command "speed as fast"
    check "a run to be edited is kept" "flown $((before + 2))"
    command "first moment"
    command "one moment on"
    command "edit the inputs"
    command "show pilot program"
    picture scientist-3-inputs-as-a-program
    command "add an entry"
    command "rerun from the moment"
    still 20
    command "hold this run"
    still 20
    command "run or pause"
    still 4
    command "run or pause"
    picture scientist-4-two-runs-compared
    command "end the comparison"
    command "views at once: 4"
    command "read buoy"
    picture scientist-5-four-views-and-a-reading
    command "views at once: 1"
    command "clear the inspector"
}

# Killed amid edits: nothing on disk is touched, and the edits are offered back.
killed() {
    command "layout design"
    command "show library"
    strength 602 "1,234 lbf"
    within 60 "grep -q '1,234 lbf' '$DATA/'recovery-*.json 2>/dev/null"
    kill -9 "$WINDOW"; wait "$WINDOW" 2>/dev/null
    check "no file was touched by edits that were not saved" "! grep -rq '1,234 lbf' '$WORK/library'"
    opened
    picture killed-1-offered-back
    check "the edits were kept" "grep -q '1,234 lbf' '$DATA/'recovery-*.json"
}

# A document opens as a page, with its pictures beside it.
documents() {
    command "read gear types"
    check "a document is opened as a page" "within 10 \"grep -q documents/gear-types.html '$WORK/pages'\""
    check "its pictures are named" "grep -q 'src=\"pictures/gear-cutter.png' '$DATA/documents/gear-types.html'"
    check "its pictures are there" "[ -f '$DATA/documents/pictures/gear-cutter.png' ]"
}

# What was chosen is kept while the window is open, for the next time.
chosen() {
    command "units noaa"
    # A window that has nothing to draw does not save itself.
    local nudge="xdotool mousemove_relative 3 0; xdotool mousemove_relative -- -3 0"
    check "units chosen are kept" "within 60 \"$nudge; grep -qs 'Noaa' '$DATA'/*.ron\" 0.5"
}

designer
regulator
scientist
killed
documents
chosen
check "the program said nothing bad" "! grep -qi 'panick' '$WORK/log'"
echo "pictures in $PICTURES, $SECONDS s"
exit $FAILED
