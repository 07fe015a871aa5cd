// SPDX-License-Identifier: GPL-3.0-or-later
#include "printed/latex_reader.hpp"

#include <doctest/doctest.h>

#include "generator/printed/latex_rows.hpp"
#include "language/parser.hpp"

using namespace dalembert;
using latex_rows::in_rows;
using latex_rows::Row;

namespace {

const Row rows[]{
    // sums, products, quotients
    {R"(a = b)", "a = b"},
    {R"(a = b = c)", "a = b = c"},
    {R"(mgl = a + b - c)", "m*g*l = a + b - c"},
    {R"(a = 2(b+c)d)", "a = 2*(b + c)*d"},
    {R"(a = -b c)", "a = -b*c"},
    {R"(a = b \cdot c \times d * f)", "a = b*c*d*f"},
    {R"(a = \frac{b}{c}\dfrac{1}{2}\tfrac12 x)", "a = b/c*(1/2)*(1/2)*x"},
    {R"(a = \frac12 m v^2)", "a = 1/2*m*v^2"},
    {R"(a = b/c)", "a = b/c"},
    {R"(a = l/2 \sin(\varphi))", "a = l/2*sin(phi)"},
    {R"(a = 1/2 m)", "a = 1/2*m"},
    {R"(a = \sin\sqrt{z} + b)", "a = sin(sqrt(z)) + b"},
    {R"(a = \mathbf{A}_k^\mathsf{T} b)", "a = transpose(A_bold_k)*b"},
    {R"(a = (\mathbf{A} - \mathbf{B})^\mathsf{T} b^{\mathsf T})", "a = transpose(A_bold - B_bold)*transpose(b)"},
    {R"(a = \int_0^l dx\, f x)", "a = integral(f*x, x, 0, l)"},
    {R"(a = \int_0^l dx \int_0^b dy\, f)", "a = integral(integral(f, y, 0, b), x, 0, l)"},
    {R"(a = \int_0^l dx)", "a = integral(1, x, 0, l)"},
    {R"(a = \left< b \right>)", "a = average(b)"},
    {R"(\vec{\boldsymbol{\nabla}} f = a)", "gradient(f) = a"},
    {R"(\begin{align} a &= b \intertext{where $b$ is a length, so} c &= d \end{align})", "a = b; c = d"},
    {R"(a = b/c\,d)", "a = b/c*d"},
    {R"(a = [b + (c - d)]\{f + g\})", "a = (b + (c - d))*(f + g)"},
    {R"(a = \left( b + c \right) \Bigl[ d \Bigr] \big( f \big))", "a = (b + c)*d*f"},
    {R"(a\,b\;c\!d~f = 0)", "a*b*c*d*f = 0"},
    {R"({a} = {b}{c})", "a = b*c"},
    // other ways to write a quotient, a derivative, a matrix of ones and zeros
    {R"(a = {b + c \over d} + \sqrt{b \over c})", "a = (b + c)/d + sqrt(b/c)"},
    {R"(a = {\mathrm d \over \mathrm dt} {\partial L \over \partial \dot q})", "a = dot(partial(L, dot(q)))"},
    {R"(a = \partial_t \rho + \partial_{xy} u + \partial_x^2 v)", "a = partial(rho, t) + partial(partial(u, y), x) + partial(partial(v, x), x)"},
    {R"(a = \partial_i u)", "a = derivative_by_index(u, i)"},
    {R"(a = \frac{{}^A d\vec{v}}{dt} + \frac{{}^B\partial u}{\partial q})", "a = in_frame(dot(v_vec), A) + in_frame(partial(u, q), B)"},
    {R"(a = \frac{D u}{D t} + \frac{\mathrm{D}}{\mathrm{D}t} (b + c))", "a = material_rate(u) + material_rate(b + c)"},
    {R"(a = \mathbf{1} b + \mathbf{R_1(\gamma)} + \mathbf{0}_{2 \times 3})", "a = one_bold*b + R_bold_1 + 0"},
    {R"(a = \bm{\nabla}\bm{\cdot}\bm{u} = 5{\times 10^{3}} b)", "a = divergence(u_bold) = 5000*b"},
    {R"(a = \left.\frac{\partial f}{\partial x}\right|_{x_0} + \left(\frac{dU}{dT}\right)_V)", "a = at(partial(f, x), x, x_0) + derivative(U, T, V)"},
    {R"(a = \int_{y=0}^{y=h} u dy)", "a = integral(u, y, 0, h)"},
    {R"(a = \iint_S f dx dy + \int_V \rho b + \int d^3 x\, f)", "a = integral_over(f, S, x, y) + integral_over(rho*b, V) + integral_over(f, x^3)"},
    {R"(a = b, \\ = c)", "a = b = c"},
    {R"(\text{Equatorial radius} = \frac{\text{Polar radius}}{2})", "Equatorial_radius = Polar_radius/2"},
    {R"(a = α β)", "a = alpha*beta"},
    {R"(a = \Delta {\mathbf x})", "a = Delta_x_bold"},
    // values, samples, and what is none
    {R"(a = K(0) + f(x, 2) + \hat{x}(k|k) + u(\cdot) + f(\mathbf{0}))", "a = value(K, 0) + value(f, x, 2) + value(x_hat, k, k) + u + value(f, 0)"},
    {R"(a = T(y = 0) + b(c + d) + n(n+1))", "a = at(T, y, 0) + b*(c + d) + n*(n + 1)"},
    {R"(x[n+1] = 4 x[n] (1 - x[n]))", "value(x, n + 1) = 4*value(x, n)*(1 - value(x, n))"},
    {R"(v(k+1) = v(k) + e(k+1))", "at(v, k, k + 1) = v + value(e, k + 1)"},
    {R"(a = G(j\omega) + h(z(t)) + b^0 + O(h^2))", "a = value(G, j*omega) + value(h, z) + b_0 + value(O, h^2)"},
    {R"(a = \frac{\partial u}{\partial y}(x, 0))", "a = value(partial(u, y), x, 0)"},
    {R"(a = g (y')^2)", "a = g*y_prime^2"},
    {R"(f dr = -dU(r))", "f*differential(r) = -differential(U)"},
    {R"(a = \bar{r}^{P_2/P_1} + {}^A\bar{v}^P)", "a = r_bar_P_2_P_1 + A_v_bar_P"},
    // without a value
    {R"(a = b + \dots + c)", "a = b + dots() + c"},
    {R"(a = \begin{bmatrix} b \\ \vdots \\ c \end{bmatrix})", "a = matrix(row(b), row(dots()), row(c))"},
    {R"(a = \min_x f(x) + \max_{x \in X, y} g + \arg\min_{u \ge 0} J)", "a = minimum_over(f, x) + maximum_over(g, x) + minimiser(J, greater_equal(u, 0))"},
    {R"(a = |n\rangle \langle m| + \langle a|H|b \rangle + \braket{a}{b} + \ket{c})", "a = ket(n)*bra(m) + braket(a, H, b) + braket(a, b) + ket(c)"},
    {R"(a = \langle b, c \rangle + <b, c>)", "a = pairing(b, c) + pairing(b, c)"},
    {R"(a = (b + c)_k + \{b, c\} + \binom{n}{k})", "a = component(b + c, k) + set(b, c) + binomial(n, k)"},
    // what stands behind an equation
    {R"(a = b \quad (x > 0))", "a = b if greater(x, 0)"},
    {R"(a = b \quad (i = 1, 2, \dots, n))", "a = b"},
    {R"(a = b \quad (\text{steady flow}))", "a = b"},
    {R"(\mathbf{A} \succ 0)", "A_bold \\succ 0"},
    // powers, roots, indices
    {R"(a = x^2 + x^{n+1} + x^{-1} + x^\alpha)", "a = x^2 + x^(n + 1) + x^-1 + x^alpha"},
    {R"(a = x_1^2 + x^2_1)", "a = x_1^2 + x_1^2"},
    {R"(a = q_{j}^2 + f_{q,j})", "a = q_j^2 + f_q_j"},
    {R"(T_{\infty} = T_\infty)", "T_inf = T_inf"},
    {R"(m_{ges} = m_\mathrm{ges} = m_{\text{ges}})", "m_ges = m_ges = m_ges"},
    {R"(x_12 = x_1 2)", "x_1*2 = x_1*2"},
    {R"(a = \sqrt{b} + \sqrt[3]{c} + \sqrt[n]{d} + \sqrt 2)", "a = sqrt(b) + c^(1/3) + d^(1/n) + sqrt(2)"},
    {R"(\theta_{zz}^{(A)} = E_{i_{12}})", "theta_zz_A = E_i_12"},
    {R"(y^* = y^{*} + q^\circ)", "y_star = y_star + q_circ"},
    {R"(y' = y'' + y^\prime)", "y_prime = y_prime_prime + y_prime"},
    // letters
    {R"(\alpha = \beta + \varphi + \vartheta + \varepsilon + \Omega)", "alpha = beta + phi + theta + epsilon + Omega"},
    {R"(\bar{x} = \hat{y} + \tilde z + \overline{R} + \underline{R})", "x_bar = y_hat + z_tilde + R_over + R_under"},
    {R"(\mathbf{r} = \boldsymbol{\tau} + \vec{v} + \bm a)", "r_bold = tau_bold + v_vec + a_bold"},
    {R"(\mathcal{V} = \tilde{\mathbf{e}}_r)", "V_cal = e_bold_tilde_r"},
    {R"({\vec {F}}_{i}^{z} = {\vec {F_{i}^{z}}} + {\vec {F}}_{i}{^{z}})", "F_vec_i_z = F_vec_i_z + F_vec_i_z"},
    {R"(\mathrm{Re} = \text{Nu}_x \mathrm{Pr}^{1/3})", "Re = Nu_x*Pr^(1/3)"},
    {R"(\Delta T = \Delta T_1^2 - \Delta x\, t)", "Delta_T = Delta_T_1^2 - Delta_x*t"},
    {R"(\mathbf{f} = \mathbf{0} = \vec 0)", "f_bold = 0 = 0"},
    // time derivatives
    {R"(\dot{x} = \ddot x + \dddot{x})", "dot(x) = ddot(x) + dot(ddot(x))"},
    {R"(\dot{q}_j^2 = \dot{\mathbf{q}} + {\ddot {\vec {r}}}_{i})", "dot(q_j)^2 = dot(q_bold) + ddot(r_vec_i)"},
    {R"(\frac{d}{dt} x = \frac{dx}{dt} = \frac{\mathrm{d}x}{\mathrm{d}t} = dx/dt)", "dot(x) = dot(x) = dot(x) = dot(x)"},
    {R"(\frac{d^2}{dt^2} x = \frac{\mathrm d^2 x}{\mathrm d t^2} = \frac{d}{dt}\dot{x})", "ddot(x) = ddot(x) = ddot(x)"},
    {R"(\frac{d}{dt} (m v) = \frac{d}{dt} \frac{1}{2} m v^2)", "dot(m*v) = dot(1/2*m*v^2)"},
    {R"(\frac{d}{dt} \frac{\partial}{\partial \dot{q}_j} T - \frac{\partial T}{\partial q_j} = 0)", "dot(partial(T, dot(q_j))) - partial(T, q_j) = 0"},
    // other derivatives
    {R"(a = \frac{dT}{dx} + \frac{d^2T(x)}{dx^2})", "a = derivative(T, x) + derivative(derivative(T, x), x)"},
    {R"(\left(\frac{\partial p}{\partial v}\right)_T = \left. \frac{\partial p}{\partial v} \right|_{T,n} = \frac{\partial p}{\partial v}\Big|_T)", "partial(p, v, T) = partial(p, v, T, n) = partial(p, v, T)"},
    {R"(\frac{\partial^2 S}{\partial E_i \partial V} = \frac{\partial^2 S}{\partial V^2})", "partial(partial(S, V), E_i) = partial(partial(S, V), V)"},
    {R"(f = \partial L/\partial \dot{q})", "f = partial(L, dot(q))"},
    {R"(q = -\lambda \frac{\partial T}{\partial y} \Big|_{y=0} = \left. T \right|_{x=a})", "q = -lambda*at(partial(T, y), y, 0) = at(T, x, a)"},
    {R"(dE = T\,ds - p\,dV)", "differential(E) = T*differential(s) - p*differential(V)"},
    {R"(dh = de + d(p v))", "differential(h) = differential(e) + differential(p*v)"},
    {R"(\delta W = \mathbf{f}^T \delta\mathbf{r})", "variation(W) = transpose(f_bold)*variation(r_bold)"},
    {R"(\frac{dp}{p} + \kappa \frac{dv}{v} = 0)", "differential(p)/p + kappa*(differential(v)/v) = 0"},
    {R"(a = \nabla p + \nabla \cdot \mathbf{q} + \nabla \times \mathbf{q})", "a = gradient(p) + divergence(q_bold) + curl(q_bold)"},
    // integrals, sums, limits
    {R"(W = \int_a^b f\,dx)", "W = integral(f, x, a, b)"},
    {R"(W = \int_{a}^{b} f(\tau) d\tau + c)", "W = integral(at(f, t, tau), tau, a, b) + c"},
    {R"(a = \int \frac{dx}{x} = \ln x)", "a = integral(1/x, x) = log(x)"},
    {R"(a = b \int_0^1 dx = \int_0^1 x + 1 \,\mathrm{d}x)", "a = b*integral(1, x, 0, 1) = integral(x + 1, x, 0, 1)"},
    {R"(I = \int_0^l \int_0^b x y\, dx dy)", "I = integral(integral(x*y, x, 0, b), y, 0, l)"},
    {R"(m = \int_{\mathcal{V}} \rho d\mathcal{V} + \int_{\partial\mathcal{V}} q dA)", "m = integral(rho, V_cal, V_cal) + integral(q, A, border(V_cal))"},
    {R"(a = \int_0^\infty e^{-x}\,dx)", "a = integral(exp(-x), x, 0, infinity)"},
    {R"(a = \int_a^b x\,dx = \left[ \frac{x^2}{2} \right]_a^b)", "a = integral(x, x, a, b) = at(x^2/2, x, b) - at(x^2/2, x, a)"},
    {R"(a = [F]_{x=0}^{1} = F\big|_{x=0}^{x=1})", "a = at(F, x, 1) - at(F, x, 0) = at(F, x, 1) - at(F, x, 0)"},
    {R"(x_S = \frac{\sum_{i=1}^n m_i x_i}{\sum_{i=1}^n m_i})", "x_S = sum(i, 1, n, m[i]*x[i])/sum(i, 1, n, m[i])"},
    {R"(J_i = \sum_{j=1}^{N} F_{ij} J_{j-1} T_{S,j}^4 + b)", "J_i = sum(j, 1, N, F[i, j]*J[j - 1]*T_S[j]^4) + b"},
    {R"(f = \prod_{k=1}^n a_k)", "f = product(a[k], k, 1, n)"},
    {R"(\lim_{x\to 0} \frac{\sin x}{x} = 1)", "limit(sin(x)/x, x, 0) = 1"},
    // functions
    {R"(a = \sin^2(\theta) + \cos(\varphi)^2)", "a = sin(theta)^2 + cos(phi)^2"},
    {R"(a = \sin 2\theta \cos\theta)", "a = sin(2*theta)*cos(theta)"},
    {R"(a = l\cos\varphi\,\dot\varphi + l\cos\varphi \dot\varphi)", "a = l*cos(phi)*dot(phi) + l*cos(phi)*dot(phi)"},
    {R"(a = \sin \omega t + \cos\frac{1}{2}\varphi + \sinh mL)", "a = sin(omega*t) + cos(1/2*phi) + sinh(m*L)"},
    {R"(a = \cos\varphi r + \sin {\varphi })", "a = cos(phi)*r + sin(phi)"},
    {R"(a = \arctan(x) + \arctan x + \arcsin(y))", "a = atan(x) + atan(x) + asin(y)"},
    {R"(a = \exp(-x) + e^{x} + \mathrm{e}^{-\frac{t}{T}} + \ln\frac{a}{b} + \log_2 x)", "a = exp(-x) + exp(x) + exp(-t/T) + log(a/b) + log(x)/log(2)"},
    {R"(a = \cot x + \coth(x) + \tanh y)", "a = 1/tan(x) + 1/tanh(x) + tanh(y)"},
    {R"(a = \operatorname{sign}(v) + \operatorname{sgn}(\dot x) + \text{sign}(x))", "a = sign(v) + sign(dot(x)) + sign(x)"},
    {R"(a = |x| + \left|\frac{x}{y}\right| + |a||b|)", "a = abs(x) + abs(x/y) + abs(a)*abs(b)"},
    {R"(a = \|\mathbf{v}\|_2^2 = \lVert\mathbf{v}\rVert)", "a = norm(v_bold)^2 = norm(v_bold)"},
    {R"(a = \min\{b, c\} - \max(b, c, d))", "a = min(b, c) - max(b, max(c, d))"},
    {R"(v(t) = V(q, \dot q) + g(t_0) + I^2(t))", "v = V + at(g, t, t_0) + I^2"},
    {R"(a = m(L-x) + c(s - s_0))", "a = m*(L - x) + c*(s - s_0)"},
    // numbers and units
    {R"(a = 0.55 + 0,55 + 0{,}55 + .5)", "a = 0.55 + 0.55 + 0.55 + 0.5"},
    {R"(a = 1\,000\,000 + 0.002\,897\,768)", "a = 1000000 + 0.002897768"},
    {R"(a = 1.52\cdot 10^9 + 2\times10^{-3} + 10^5)", "a = 1520000000 + 0.002 + 100000"},
    {R"(g = 9.81\,\mathrm{m}/\mathrm{s}^2)", "g = quantity(9.81, m/s^2)"},
    {R"(g = 9{,}81\,\frac{\mathrm{m}}{\mathrm{s}^2} = 9.81\,\mathrm{m\,s^{-2}} = 9.81\,\mathrm{m/s^2})", "g = quantity(9.81, m/s^2) = quantity(9.81, m*s^-2) = quantity(9.81, m/s^2)"},
    {R"(M = 3\,\mathrm{N\,m} = 2\cdot 10^5\,\mathrm{Pa}\cdot\mathrm{m}^3)", "M = quantity(3, N*m) = quantity(200000, Pa*m^3)"},
    {R"(T = 276.75 \text{ K} = -8.40^\circ\text{C} = 3.08 \text{ °C})", "T = quantity(276.75, K) = quantity(-8.4, degC) = quantity(3.08, degC)"},
    {R"(\varphi = 90^\circ = 50\,\%)", "phi = quantity(90, deg) = quantity(50, percent)"},
    {R"(k = 5\,\mathrm{\mu m} \, x)", "k = quantity(5, um)*x"},
    {R"(\mathrm{Nu} = 0.3\,\mathrm{Re})", "Nu = 0.3*Re"},
    // vectors and matrices
    {R"(T = \frac{1}{2}\dot{\mathbf{q}}^T \mathbf{M} \dot{\mathbf{q}} = \mathbf{v}^{\mathrm T}\mathbf{v})", "T = 1/2*transpose(dot(q_bold))*M_bold*dot(q_bold) = transpose(v_bold)*v_bold"},
    {R"(P = \mathbf{f} \cdot \mathbf{v})", "P = inner(f_bold, v_bold)"},
    {R"(\mathbf{l} = \mathbf{r} \times m\mathbf{v})", "l_bold = cross(r_bold, m*v_bold)"},
    {R"(\mathbf{x} = \mathbf{A}^{-1} \mathbf{b} + (\mathbf{E} - \mathbf{F})^{-1}\mathbf{c})", "x_bold = inverse(A_bold)*b_bold + inverse(E_bold - F_bold)*c_bold"},
    {R"(\mathbf{r} = [l \sin(\theta), -l, 0]^T = (a, b, c)^T)", "r_bold = transpose(row(l*sin(theta), -l, 0)) = transpose(row(a, b, c))"},
    {R"(A = \begin{pmatrix} a & b \\ c & d \\ \end{pmatrix} \begin{bmatrix} x \\ y \end{bmatrix})", "A = matrix(row(a, b), row(c, d))*matrix(row(x), row(y))"},
    {R"(A = \left[\begin{array}{cc} 1 & 0 \\ 0 & 1 \end{array}\right])", "A = matrix(row(1, 0), row(0, 1))"},
    {R"(a = \det(\mathbf{J}) = \begin{vmatrix} a & b \\ c & d \end{vmatrix} = \left|\begin{matrix} a & b \\ c & d \end{matrix}\right|)",
     "a = determinant(J_bold) = determinant(matrix(row(a, b), row(c, d))) = determinant(matrix(row(a, b), row(c, d)))"},
    {R"(\mathbf{y}_j^{*T} = \text{diag}\{\boldsymbol{\varepsilon}\})", "transpose(y_bold_j_star) = diag(epsilon_bold)"},
    // pieces
    {R"(y = \begin{cases} a & \text{für } x>0 \\ b & \text{sonst} \end{cases})", "y = cases(a, greater(x, 0), b)"},
    {R"(y = \left\{\begin{array}{ll} a, & 0 \le x < 1 \\ b, & x = 1 \end{array}\right.)", "y = cases(a, both(less_equal(0, x), less(x, 1)), b, equal(x, 1))"},
    {R"(y = \begin{cases} a & \text{if } x\in[0,L) \text{ und } y \neq 0 \\ b & \text{otherwise} \end{cases}.)",
     "y = cases(a, both(both(greater_equal(x, 0), less(x, L)), not_equal(y, 0)), b)"},
    // the text around
    {R"(a = b . \quad (2.3))", "a = b"},
    {R"(a = b, \tag{2.3a} \label{eq:x})", "a = b"},
    {R"($$a = b \nonumber$$)", "a = b"},
    {R"(a = 1.5 (x + y)\quad (A.3))", "a = 1.5*(x + y)"},
    {R"(a = b, \quad c = d)", "a = b; c = d"},
    {R"(a = b \quad \text{und} \quad c = d)", "a = b; c = d"},
    {R"(a = b \mbox{ bzw. } c = d \text{ and } f = g)", "a = b; c = d; f = g"},
    {R"(a = b, c = d \Rightarrow f = g)", "a = b; c = d; f = g"},
    {R"(\begin{aligned} a &= b \\ &= c \\ d &= f \end{aligned})", "a = b = c; d = f"},
    {R"(\begin{align*} a &= b \\[2mm] &\quad + c, \\ d &= f - g \\ &- h \end{align*})", "a = b + c; d = f - g - h"},
    {R"(a = \\ - b)", "a = -b"},
    {R"(\left. \begin{array}{l} a = b \\ c = d \end{array} \right\})", "a = b; c = d"},
    {R"(\mathbf{e}_x : \quad a = b)", "a = b"},
    {R"(\underbrace{a + b}_{=c} d = \underbrace{v_0}_{=0} + \boxed{f})", "(a + b)*d = v_0 + f"},
    {R"(\boxed{a = b})", "a = b"},
    {R"({a + b = c})", "a + b = c"},
    {R"(a \stackrel{!}{=} b := c)", "a = b = c"},
    {R"(\Psi \approx 0.484)", "Psi \\approx 0.484"},
    {R"(a \le b < c \geq d)", "a \\le b < c \\ge d"},
    {R"(p = \text{konst.}, \quad v = \mathrm{const}.)", "p = constant; v = constant"},
    {R"(a = b \quad \text{für } x \geq 0)", "a = b if greater_equal(x, 0)"},
    {R"(a_j = b, \quad j = 1, \dots, n)", "a_j = b"},
    {R"(T = T_r \quad \forall x \in (0, L))", "T = T_r"},
    {R"(\eta = \frac{a}{b} \in [0, 1])", "eta = a/b"},
    {"a = b % a remark\n + c", "a = b + c"},
};

}  // namespace

TEST_CASE("LaTeX in the model language") {
    for (const Row& row : rows) {
        CAPTURE(row.latex);
        std::string read;
        try {
            read = in_rows(row.latex);
        } catch (const Failure& failure) {
            read = failure.what();
        }
        CHECK(read == row.model);
    }
}

TEST_CASE("what is read is written as the model language reads it") {
    for (const Row& row : rows)
        for (const LatexEquation& read : read_latex(latex_rows::text(row.latex), {}))
            for (const ExpressionPtr& side : read.equation.sides) {
                const std::string written = in_model_language(*side);
                CHECK(in_model_language(*parse_expression(latex_rows::text(written))) == written);
            }
}

TEST_CASE("the notation decides") {
    PrintedNotation notation;
    notation.define("T", "kinetic_energy");
    notation.define(R"(\dot{V}_1)", "V_1_dot");
    notation.define(R"(f_{\varphi})", "generalised_force[phi]");
    notation.define(R"({\vec {F}}_{i}^{e})", "F_e[i]");
    notation.define("F^e", "F_e");
    notation.define("e", "e");
    notation.define("d", "d");
    notation.define("ml", "ml");
    notation.define("Q^{1}", "Q");
    notation.define(R"(\delta)", "delta");
    notation.define_function("V", {});
    notation.define_function("u", {"x", "t"});
    notation.define_function(R"(\dot{Q})", {"x"});
    notation.add_index("k");
    notation.add_word("ges");
    CHECK(in_rows("T_1 = 2T", notation) == "T_1 = 2*kinetic_energy");
    CHECK(in_rows(R"(\dot{V}_1 = \dot V_2 + \ddot{V}_1)", notation) == "V_1_dot = dot(V_2) + ddot(V_1)");
    CHECK(in_rows(R"(f_\varphi = \dot{T})", notation) == "generalised_force[phi] = dot(kinetic_energy)");
    CHECK(in_rows(R"(\vec{F}_i^e = F^e + F^2 + G^e)", notation) == "F_e[i] = F_e + F^2 + G^e");
    CHECK(in_rows("e^{x} = e_1", notation) == "e^x = e_1");
    CHECK(in_rows(R"(dx = d(a + b) + \delta x)", notation) == "d*x = d*(a + b) + delta*x");
    CHECK(in_rows(R"(\int_0^1 d\,x\,dx = \frac{d}{dt} x)", notation) == "integral(d*x, x, 0, 1) = dot(x)");
    CHECK(in_rows("mlg = m l", notation) == "ml*g = m*l");
    CHECK(in_rows("Q^1 = Q^2", notation) == "Q = Q^2");
    CHECK(in_rows("V(a) = W(a + b)", notation) == "V = W*(a + b)");
    CHECK(in_rows(R"(u(x, t) = u(0, t) + u(x, \tau) + \dot{u}(L, t))", notation) == "u = at(u, x, 0) + at(u, t, tau) + at(dot(u), x, L)");
    CHECK(in_rows(R"(\dot{Q}(0) = \dot Q)", notation) == "at(dot(Q), x, 0) = dot(Q)");
    CHECK(in_rows("m_k = m_{k+1} a_{S,k}", notation) == "m[k] = m[k + 1]*a_S[k]");
    CHECK(canonical_letter(latex_rows::text(R"({\dot {V}}_{1})"), {}) == R"(\dot{V}_1)");
    CHECK(canonical_letter(latex_rows::text(R"(\boldsymbol \tau_{a\lambda b}^{( A )})"), {}) == R"(\mathbf{\tau}_{a\lambda b}^{(A)})");
}

TEST_CASE("every part stands where it was printed") {
    const auto all = read_latex(latex_rows::text(R"(x = \frac{1}{2} m\dot{x}^2 + \sin(\varphi), y = -b)"), {});
    REQUIRE(all.size() == 2);
    const Expression& right = *all[0].equation.sides[1];
    CHECK(right.written() == R"(\frac{1}{2} m\dot{x}^2 + \sin(\varphi))");
    CHECK(right.children[0]->children[1]->written() == R"(\dot{x}^2)");
    CHECK(right.children[1]->written() == R"(\sin(\varphi))");
    CHECK(right.children[1]->children[0]->written() == R"((\varphi))");
    CHECK(all[1].equation.sides[1]->written() == "-b");
    CHECK(all[1].equation.span.text() == "y = -b");
    const auto ranged = read_latex(latex_rows::text(R"(a = b \quad \forall x \in (0, L))"), {});
    REQUIRE(ranged.size() == 1);
    REQUIRE(ranged[0].ranges.size() == 1);
    CHECK(ranged[0].ranges[0].text() == R"(\forall x \in (0, L))");
}
