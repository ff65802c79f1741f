#!/bin/bash
# Pictures of every panel, in both themes, at a size: to be looked at. A short encounter is flown first, so that every panel has
# something to show; it is held as B and flown again with another tide, so that A and B can be compared.
#
#   tests/window/pictures.sh target/debug/endline FOLDER [1280x720]
set -u
PROGRAM=$(realpath "${1:?the program to drive, such as target/debug/endline}")
PICTURES=${2:?a folder for the pictures}
SIZE=${3:-1280x720}
. "$(dirname "$0")/lib.sh"
sed -i 's/^duration = .*/duration = "20 s"/; s/^rope_nodes.*/rope_nodes = 200/' "$WORK/library/scenarios/hello-endline.toml"

flown() {
    command "run or pause"
    within 300 "[ \$(ls '$DATA/recordings' 2>/dev/null | grep -c 'endline$') -ge $1 ]"
}
# Names of pictures begin with the theme.
layouts() {
    command "$1"
    command "layout design"; command "show 3-d view"; picture "$1-design"
    command "show assembly"; picture "$1-assembly" 30
    command "show summary"; command "show problems"; picture "$1-problems-summary"
    command "show events"; picture "$1-events"
    command "layout fly"; picture "$1-fly"
    command "show pad"; picture "$1-pad"
    command "show scenario"; picture "$1-scenario"
    command "layout review"; picture "$1-review"
    command "show pilot program"; command "show recordings"; picture "$1-pilot-recordings"
    command "show compare"; picture "$1-compare"
    command "show run"; command "views at once: 4"; picture "$1-four-views-run"
    command "views at once: 1"
    command "layout study"; command "open study weak-link"; picture "$1-study" 60
    command "layout search"; command "open observation eg-5120"; picture "$1-search" 60
    command "layout design"; command "show 3-d view"
    command "show plugins"; picture "$1-plugins"
    command "show keys and help"; picture "$1-help"
    command "show start"; picture "$1-start"
    keys ctrl+p; picture "$1-palette"; keys Escape
}
tables() {
    command "layout design"
    for TABLE in ropes traps buoys "weak links" knots anchors sites friction whales; do
        command "table of $TABLE"; picture "$1-table-$TABLE"
    done
}

opened
picture dark-first-start
command "layout design"
command "speed as fast"
flown 1
layouts dark
tables dark
layouts light
tables light
echo "$(ls "$PICTURES" | wc -l) pictures in $PICTURES, $SECONDS s"
exit $FAILED
