# Messages, timed steps with logs, and the lock. Sourced by ./brainshift.
# shellcheck shell=bash

export HOME=~ # ~ is known where HOME is not, as in some build servers
cache=${XDG_CACHE_HOME:-$HOME/.cache}/brainshift

# Messages go to stderr, so that the output of `shell -- COMMAND` stays clean.
say() { printf 'brainshift: %s\n' "$*" >&2; }

# fail STATUS SENTENCE
fail() {
  say "$2"
  exit "$1"
}

# step LOG MESSAGE COMMAND…: one line to read; the command's own output goes to the file LOG.log, in the
# cache unless LOG is a path.
step() {
  local log=$1.log message=$2 start=$SECONDS status=0
  shift 2
  [[ $log == /* ]] || log=$cache/log/$log
  mkdir -p "$(dirname "$log")"
  printf 'brainshift: %s ... ' "$message" >&2
  ("$@") >"$log" 2>&1 </dev/null || status=$?
  if ((status != 0)); then
    echo failed >&2
    tail -n 40 "$log" >&2
    fail 1 "$message failed; above is the end of its log, $log"
  fi
  echo "$((SECONDS - start)) s" >&2
}

# lock FILE WHAT: waits until no other launch does WHAT, and says so. Children inherit the lock: where
# a launch was killed, the next one waits for what it left running.
lock() {
  mkdir -p "$(dirname "$1")" || fail 1 "Cannot write to the folder $(dirname "$1")"
  exec 9>"$1"
  if ! flock --nonblock 9; then
    say "waiting for another brainshift, which $2"
    flock 9
  fi
}

unlock() { exec 9>&-; }

# lock_setup NAME: launches from all checkouts share this machine's packages and the root filesystems.
# Each has a lock of its own: two releases of Debian are set up side by side.
lock_setup() { lock "$cache/$1.lock" "sets up $1"; }
