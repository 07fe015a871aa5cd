# SPDX-License-Identifier: GPL-3.0-or-later
# A page of a lecture as it is printed: '\approx 0' had a unit, two rows were no vector of a plane, and a bold letter had no remedy.
sed '/^\[catalogue\]/,$d' "$SOURCE/tests/regressions/corrections_pasted_back.toml" >cart.toml
cp "$model" page.toml
cp "$SOURCE/systems/mechanics/spherical_pendulum.toml" .
dalembert 2 check page.toml
for one in 'about zero' 'zero about' 'zero beside a rounded number' 'two rows' 'two rows of a velocity' 'two rows of a force'; do
  prints "^  $one +proven$"
done
prints '^  not about zero +not checkable$'
prints "^  between expressions +not read: '.approx' between 'm_2 g s .sin.varphi' and 'm_2 g s .varphi' does not say how near they are"
prints '^  two wrong rows +wrong$'
prints '^  a row of zero +wrong$'
[ "$(grep -c '^      corrected:  .mathbf r_S = .begin{pmatrix} x + s.sin.varphi' printed)" -eq 2 ] || fail "not both vectors are mended"
prints '^  not in a plane +dimensionally wrong$'
prints "is 2 by 1, but another side .* 3 by 1, of which the third row is not zero; for two rows write vector.position.bob, 1., position.bob, 2.."
prints "^  bold +not read: 'r_bold_S' is not defined; write with = . r_bold_S = \"...\" ., or '.mathbf r_S' = \"r_S\" under .notation."
prints "^  differential +not read: 'd_dot_phi' is not defined; 'd.dot.varphi' is read as a differential. For d times .dot.varphi write d.,.dot"
prints "^  variation +not read: 'delta_x' is not defined$"
