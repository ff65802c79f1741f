# What drives the workbench's window: a screen of its own (Xvfb), real mouse and keys (xdotool), pictures (imagemagick).
# Sourced by the scripts beside it, after PROGRAM, PICTURES and SIZE are set. Nothing waits for a time where there is something
# to wait for: a command until the program has reported that it performed it, a picture until the window stands still.
ROOT=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
WORK=$(mktemp -d)
FAILED=0
WINDOW=
mkdir -p "$PICTURES"
cp -r "$ROOT/gear-library" "$WORK/library"
# Each command that the program performs is a line of its log.
export XDG_DATA_HOME="$WORK/data" LIBGL_ALWAYS_SOFTWARE=1 ENDLINE_TELL_COMMANDS=1
DATA="$WORK/data/endline"
# What the program opens with the system's own programs is noted, and no browser comes before the window.
mkdir "$WORK/bin"
printf '#!/bin/sh\necho "$1" >>"%s/pages"\n' "$WORK" >"$WORK/bin/xdg-open"
chmod +x "$WORK/bin/xdg-open"
export PATH="$WORK/bin:$PATH"
# No desktop portal: the window asks for paths itself, and no dialog opens on somebody's own screen.
export DBUS_SESSION_BUS_ADDRESS=disabled:

. "$ROOT/tests/window/screen.sh"
trap 'kill $WINDOW $SCREEN 2>/dev/null; rm -rf "$WORK"' EXIT

screen() { import -window root -depth 8 rgb:- 2>/dev/null | md5sum; }
# Waits until nothing on the screen has changed for some time, at most so many seconds.
still() {
    local end=$((SECONDS + ${1:-10})) before now same=0
    before=$(screen)
    while [ $SECONDS -lt $end ] && [ $same -lt 2 ]; do
        sleep 0.15
        now=$(screen)
        if [ "$now" = "$before" ]; then same=$((same + 1)); else same=0; fi
        before=$now
    done
}
picture() { still "${2:-10}"; import -window root "$PICTURES/$1.png"; }
click() { xdotool mousemove "$1" "$2"; still 5; xdotool click 1; still 5; }
keys() { xdotool key --delay 30 "$@"; }
typed() { xdotool type --delay 5 "$1"; }
performed() { grep -c "^command: ${1:-}" "$WORK/log"; }
# A path typed where the window asks for one.
path() { still 10; keys ctrl+a; typed "$1"; keys Return; }
# A command by its name in the palette.
command() {
    local before
    before=$(performed window.palette)
    keys ctrl+p
    within 30 "[ \$(performed window.palette) -gt $before ]"
    before=$(performed)
    typed "$1"
    keys Return
    within 30 "[ \$(performed) -gt $before ]" || { echo "WRONG no such command: $1"; FAILED=1; keys Escape; }
}
check() { if eval "$2"; then echo "ok    $1"; else echo "WRONG $1"; FAILED=1; picture "wrong-$(echo "$1" | tr -c 'a-z\n' -)"; fi; }

# The window at the screen's size.
opened() {
    "$PROGRAM" --library "$WORK/library" >>"$WORK/log" 2>&1 &
    WINDOW=$!
    within 120 "ID=\$(xdotool search --onlyvisible --name '^Endline\$' 2>/dev/null) || ! kill -0 $WINDOW 2>/dev/null" 0.25
    if [ -z "${ID:-}" ]; then echo "WRONG no window: $(tail -3 "$WORK/log")"; exit 1; fi
    xdotool windowmove "$ID" 0 0 windowsize "$ID" "${SIZE%x*}" "${SIZE#*x}" windowfocus "$ID"
    still 30
}
