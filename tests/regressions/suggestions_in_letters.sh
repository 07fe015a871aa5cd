# SPDX-License-Identifier: GPL-3.0-or-later
# Suggestions were in the letters of models, could lie inside of what a letter stands for, and missed letters, squares and integrals.
dalembert 1 check "$model" -o pages
# entry NAME MENDED CARETS: what is suggested of an entry, and how many characters are marked
entry() {
  awk -v name="  $1 " 'index($0, name) == 1 { on = 1; next } /^  [^ ]/ { on = 0 } on' printed >entry
  grep -qxF "      corrected:  $2" entry || { fail "not suggested of '$1': $2"; cat entry; }
  [ "$(grep -A1 '^      corrected:' entry | tail -1 | tr -dc '^' | wc -c)" -eq "$3" ] || { fail "marked in '$1':"; cat entry; }
}
entry 'sign' 'E = \half m v^2 + \half c s^2' 1
entry 'function of a letter of the notation' 'E = m g l \sin\varphi' 4
entry 'letter' 'E = l m g \sin \varphi_1' 2
entry 'square of a rate' 'E = \half m \dot{x}^2' 2
entry 'square of a bracket' 'E = \half c (s - z)^2' 2
entry 'tanh' 'E = m g l \tanh b' 5
entry 'sign of an integral' 'E = -\int_0^h m g\, dz' 1
entry 'sign of an integral without primitive' 'E = -\int_0^l c l \exp(-z^2/l^2) \frac{\sin(z/l)}{1 + z/l} dz' 1
entry 'lines' 'E = m g h \quad + \frac{c s^2}{2}' 1
awk '/^  inside of the notation /{ on = 1; next } /^  [^ ]/ { on = 0 } on' printed | grep -q perhaps && fail "a suggestion inside of the notation"
prints_not 'corrected: +q = (0|p - p)$'
grep -q '<code>E = .half m v^2 <mark>+</mark>' pages/book.html || fail "the slip is not marked on the page"
