# Makes a manual page of what a program prints with --help, so that no option is described twice:
#   PROGRAM --help | awk -v name=PROGRAM -v version=X -v what="one line" -f make_man.awk
# The layout of --help: command lines, a blank line; "  TERM  meaning" for each option, two
# blanks between; "exit code: ..."; the rest is text. A line that begins further in goes on.

function roff(text) {
  gsub(/\\/, "\\e", text)
  gsub(/-/, "\\-", text)
  if (text ~ /^[.']/) text = "\\&" text
  return text
}

function section(title) {
  if (title != open_section) print ".SH " title
  open_section = title
}

BEGIN {
  printf ".TH %s 1 \"\" \"bipact %s\" \"bipact\"\n", toupper(name), roff(version)
  section("NAME")
  print roff(name) " \\- " roff(what)
  section("SYNOPSIS")
  print ".nf"
  synopsis = 1
}

synopsis && /^$/ {
  synopsis = 0
  print ".fi"
  next
}
synopsis { print roff($0); next }
/^$/ { next }

/^  [^ ]/ {
  section("OPTIONS")
  text = substr($0, 3)
  gap = index(text, "  ")
  print ".TP"
  print ".B " roff(substr(text, 1, gap - 1))
  text = substr(text, gap)
  sub(/^ +/, "", text)
  print roff(text)
  next
}

/^exit code: / {
  section("EXIT STATUS")
  print roff(substr($0, 12))
  next
}

/^ / {
  sub(/^ +/, "")
  print roff($0)
  next
}

{
  section("NOTES")
  print roff($0)
}

END {
  if (see == "") exit
  section("SEE ALSO")
  print roff(see)
}
