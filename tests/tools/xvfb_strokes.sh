#!/usr/bin/env bash
# A window on a virtual display, driven by real X events: a stroke, undo, redo, save, quit.
# Usage: xvfb-run -s "-screen 0 1440x900x24" bash xvfb_strokes.sh ARGIL OUT; prints what went wrong, status 1.
set -u
argil=$1 out=$2
wait_for() { # as long as it takes, but not for ever
  for _ in $(seq 600); do
    eval "$1" && return 0
    sleep 0.1
  done
  echo "waited in vain for: $1" >&2
  kill -9 "$program"
  exit 1
}
journal=$out/journal.argil
"$argil" studio --out "$out" &
program=$!
wait_for 'window=$(xdotool search --onlyvisible --name "^Argil$" | head -1) && [ -n "$window" ]'
wait_for 'grep -q "^tool pull" "$journal" 2>/dev/null'
# On a busy machine an event may come before the window is ready for it: what has no effect is done again.
until_seen() { # PATTERN COMMAND…
  local pattern=$1
  shift
  for _ in $(seq 12); do
    xdotool windowfocus "$window"
    "$@"
    for _ in $(seq 30); do
      grep -q "$pattern" "$journal" && return 0
      sleep 0.1
    done
  done
  echo "waited in vain for $pattern" >&2
  kill -9 "$program"
  exit 1
}
stroke() {
  sleep 1
  xdotool mousemove 600 330
  sleep 0.3
  xdotool mousedown 1
  for i in $(seq 15); do
    xdotool mousemove 600 $((330 - 5 * i))
    sleep 0.05
  done
  xdotool mouseup 1
}
until_seen "^stroke path" stroke
until_seen "^commit" sleep 0.1
until_seen "^undo" xdotool key ctrl+z
until_seen "^redo" xdotool key ctrl+shift+z
# On a busy machine a dialogue may come later than what is typed into it.
for _ in $(seq 6); do
  xdotool key ctrl+s
  sleep 1.5
  xdotool keydown ctrl
  sleep 0.3
  xdotool key a
  sleep 0.3
  xdotool keyup ctrl
  xdotool type --delay 60 "$out/saved.argil"
  sleep 0.5
  xdotool key Return
  sleep 1.5
  [ -s "$out/saved.argil" ] && break
  xdotool key Escape
  sleep 0.5
done
[ -s "$out/saved.argil" ] || {
  echo "the session was not saved" >&2
  kill -9 "$program"
  exit 1
}
for _ in $(seq 20); do
  kill -0 "$program" 2>/dev/null || break
  xdotool key ctrl+q
  sleep 1
done
wait "$program"
