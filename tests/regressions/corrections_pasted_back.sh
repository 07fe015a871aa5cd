# SPDX-License-Identifier: GPL-3.0-or-later
# Corrections lost '&' and '\\' of matrices, doubled a minus, and put factors beside the model's own quantity. Each has to be LaTeX that can
# be pasted back, and is proven then; and it changes the side that the text prints.
sed '/^\[catalogue\]/,$d' "$model" >cart.toml
sed -n '/^\[catalogue\]/,$p' "$model" >page.toml
dalembert 1 check page.toml
# entry NAME MENDED
entry() {
  awk -v name="  $1 " 'index($0, name) == 1 { on = 1; next } /^  [^ ]/ { on = 0 } on' printed >entry
  grep -qxF "      corrected:  $2" entry || { fail "not suggested of '$1': $2"; cat entry; }
}
r='\mathbf r_S = \begin{pmatrix} x + s\sin\varphi \\ -s\cos\varphi \end{pmatrix}'
M='\mathbf M = \begin{pmatrix} m_1 + m_2 & m_2 s\cos\varphi \\ m_2 s\cos\varphi & J_S + m_2 s^2 \end{pmatrix}'
P='\frac{\mathrm d}{\mathrm dt}\left( T + V \right) = -d\,\dot\varphi^2'
V='V = \frac{1}{2}\, c\, x^2 - m_2\, g\, s \cos\varphi'
entry 'matrix' "$M"
entry 'first row' "$r"
entry 'second row' "$r"
entry 'double minus' "$V"
entry 'number before' "$P"
entry 'half before' "$P"
entry 'minus before' "$P"
entry 'number below' "$V"
entry 'number above' "$V"
entry 'quarter' "$V"
entry 'comment' 'V = \frac{1}{2}\, c\, x^2 - m_2\, g\, s \cos\varphi'
entry 'cases' 'V = \begin{cases} \frac{1}{2} c x^2 - m_2 g s \cos\varphi & \text{for } x > 0 \\ \frac{1}{2} c x^2 - m_2 g s \cos\varphi & \text{otherwise} \end{cases}'
cp printed first
awk '/^\[entries/ { exit } { print }' page.toml >mended.toml
grep '^      corrected:' first | sed 's/^      corrected:  //' | awk -v quote="'''" '
  { printf "[entries.\"%d\"]\nmodel = \"cart.toml\"\nlatex = %s%s%s\n", NR, quote, $0, quote }
  /mathbf r/ { print "with = { r_bold_S = \"vector(position[bar, 1], position[bar, 2])\" }" }
  /mathbf M/ { print "with = { M_bold = \"matrix(row(mass_matrix[x, x], mass_matrix[x, phi]), row(mass_matrix[phi, x], mass_matrix[phi, phi]))\" }" }
' >>mended.toml
dalembert 0 check mended.toml
prints '^12 printed equations: 12 proven$'
