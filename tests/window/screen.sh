# Starts a screen of its own (Xvfb) of SIZE, on a number that is free, and sets DISPLAY and SCREEN, its process. Sourced.

# Waits until something is so, at most so many seconds.
within() { local end=$((SECONDS + $1)); until eval "$2"; do [ $SECONDS -lt $end ] || return 1; sleep "${3:-0.1}"; done; }

SCREENS=$(seq $((100 + $$ % 400)) $((600 + $$ % 400)))
for NUMBER in $SCREENS; do
    [ -e "/tmp/.X$NUMBER-lock" ] && continue
    export DISPLAY=":$NUMBER"
    Xvfb "$DISPLAY" -screen 0 "${SIZE}x24" >/dev/null 2>&1 &
    SCREEN=$!
    within 30 "[ -e '/tmp/.X11-unix/X$NUMBER' ] || ! kill -0 $SCREEN 2>/dev/null"
    kill -0 $SCREEN 2>/dev/null && break
done
