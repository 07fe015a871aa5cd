# SPDX-License-Identifier: GPL-3.0-or-later
# The page of a catalogue hid `at`, showed names of the model as printed and one entry of a vector, moved what is not read to its end, and a
# linearised equation was only wrong.
sed '/^\[catalogue\]/,$d' "$SOURCE/tests/regressions/corrections_pasted_back.toml" >cart.toml
cp "$model" page.toml
dalembert 2 check page.toml -o pages
prints '^  Lagrangian +proven$'
prints '^  frequency +proven at phi = 0$'
prints "^  long point +proven at the point of 'at'$"
prints '^  linearised +not checkable$'
prints "^      reason: +the two sides differ, and '.approx' does not say how near they are$"
prints '^  linear in the angle +wrong$'
[ "$(grep -c '^      hint: +holds to first order about x = 0, phi = 0$' -E printed)" -eq 2 ] || { fail "not two hints"; cat printed; }
prints '^pages/book.html$'
prints '^pages/errata.html$'
# section NAME: its lines on the page
section() { awk -v name="<h3>$1 " 'index($0, name) == 1 { on = 1 } /<\/section>/ { on = 0 } on' pages/book.html >section; }
shows() { grep -qF -e "$1" section || { fail "not shown: $1"; cat section; }; }
grep -q '<h1>Cart with a bar, page 2</h1>' pages/book.html || fail "the title is not that of the catalogue"
grep -q '<h1>Errata: Cart with a bar, page 2</h1>' pages/errata.html || fail "the title of the errata is not that of the catalogue"
section 'Lagrangian'
shows '<mi>L</mi><mo>=</mo><mi>T</mi><mo>−</mo><mi>V</mi><mo>=</mo>'
section 'frequency'
shows 'at <math>'
shows '; with <math>'
section 'vector'
shows '<mtable><mtr><mtd><mi>x</mi><mo>+</mo>'
[ "$(grep -o '<mtr>' section | wc -l)" -eq 4 ] || fail "not two rows printed and two rows derived"
section 'linearised'
shows 'It holds to first order about x = 0, phi = 0.'
[ "$(grep -o '<h3>[^<]*' pages/book.html | sed -n 2p)" = '<h3>not read ' ] || fail "what is not read is not in its place"
grep -q '<tr><th>entries</th><td>8</td></tr>' pages/book.html || fail "what is not read does not count"
grep -q '<tr><th>not read</th><td>1</td></tr>' pages/book.html || fail "what is not read is not in the table"
dalembert 2 check page.toml -o pages --format json
prints '"at": \['
prints '"hint": "holds to first order about x = 0, phi = 0"'
