"""Runs that find no room: a limit on the size of files or on memory, a small file system."""

import os
import resource
import shutil
import signal
import subprocess

from scenes import BIPACT, TMP, check


def limited(bytes_of_file=None, bytes_of_memory=None):
    """Limits of a child: a write beyond the first fails as on a full disk."""

    def set_limits():
        if bytes_of_file:
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (bytes_of_file, bytes_of_file))
        if bytes_of_memory:
            resource.setrlimit(resource.RLIMIT_AS, (bytes_of_memory, bytes_of_memory))

    return set_limits


def starved(deck, folder, *options, **limits):
    done = subprocess.run(
        [BIPACT, deck, "-o", folder, "--quiet"] + list(options),
        capture_output=True,
        text=True,
        preexec_fn=limited(**limits),
    )
    return done.returncode, done.stderr


def one_message(code, errors, words, what):
    """Exit 3, one message with these words."""
    check(code == 3 and words in errors, "%s: %d %s" % (what, code, errors))
    check(errors.count("bipact: ") == 1, "%s: one message: %s" % (what, errors))


def on_small_disk(size, deck, copy):
    """Runs a deck in an empty file system of a size ("600k") and copies what is left; (exit code,
    messages), None where none can be mounted, neither by the superuser nor in a name space."""
    small = os.path.join(TMP, "small")
    os.makedirs(small, exist_ok=True)
    shutil.rmtree(copy, ignore_errors=True)
    script = """mount -t tmpfs -o size=$1 none "$2" || exit 99
        "$3" "$4" -o "$2/run" --quiet; code=$?
        cp -r "$2/run" "$5"; umount "$2"; exit $code"""
    words = ["sh", "-c", script, "sh", size, small, BIPACT, deck, copy]
    for prefix in ([], ["unshare", "--map-root-user", "--mount"]):
        try:
            done = subprocess.run(prefix + words, capture_output=True, text=True)
        except FileNotFoundError:
            continue
        if os.path.isdir(copy):
            return done.returncode, done.stderr
    return None
