% SPDX-License-Identifier: GPL-3.0-or-later
% Checks an exported folder: octave octave.m FOLDER POINTS RUN. POINTS and RUN are written by octave.sh: values by the table, and a run by the program.
paths = argv();
[~, name] = fileparts(paths{1});
addpath(paths{1});
plant = feval(name);
problems = 0;

function count = check(is_good, what)
  count = 0;
  if ~is_good
    printf('%s\n', what);
    count = 1;
  end
end

function count = refused(call, words)
  count = 0;
  try
    call();
    printf('nothing is said of ''%s''\n', words);
    count = 1;
  catch e
    if isempty(strfind(e.message, words))
      printf('''%s'' does not say ''%s''\n', e.message, words);
      count = 1;
    end
  end
end

n = numel(plant.states); m = numel(plant.inputs); k = numel(plant.outputs); q = numel(plant.parameters);
expected = load(paths{2});  % struct: x, u, t, mode, and values by the names of the functions
points = numel(expected.t);
vectors = {'rhs', 'jacobian_t', 'output', 'output_jacobian_t', 'energies', 'powers', 'guard_values', 'holds'};
matrices = {'jacobian_x', 'jacobian_u', 'jacobian_p', 'output_jacobian_x', 'output_jacobian_u', 'output_jacobian_p', 'mass_matrix'};
for f = [vectors, matrices]
  f = f{1};
  if ~isfield(expected, f), continue; end
  is_vector = any(strcmp(f, vectors));
  many = plant.(f)(expected.t, expected.x, expected.u, [], expected.mode);
  for i = 1:points
    one = plant.(f)(expected.t(i), expected.x(:, i), expected.u(:, i), [], expected.mode(i));
    if is_vector
      own = many(:, i); value = expected.(f)(:, i);
    else
      own = many(:, :, i); value = reshape(expected.(f)(:, :, i), size(own));
    end
    problems += check(isequaln(full(one), own), [f ' at many points is not that at one']);
    problems += check(isequaln(full(one), value), [f ' is not that of the table']);
  end
end

% Parameters, by struct and vector; names and errors.
x0 = plant.start();
p = plant.p;
problems += check(numel(fieldnames(p)) == q, 'parameters');
vector = cell2mat(struct2cell(p));
problems += check(isequaln(plant.rhs(0, x0, [], p), plant.rhs(0, x0)) && isequaln(plant.rhs(0, x0, [], vector), plant.rhs(0, x0)), 'default parameters');
if q > 0
  fields = fieldnames(p);
  p.(fields{1}) = 1.01 * p.(fields{1});
  vector(1) *= 1.01;
  problems += check(isequaln(plant.rhs(0, x0, [], p), plant.rhs(0, x0, [], vector)), 'a parameter that is set');
  p.no_such = 1;
  problems += refused(@() plant.rhs(0, x0, [], p), 'there is no parameter ''no_such''');
  problems += refused(@() plant.rhs(0, x0, [], ones(q + 1, 1)), 'real numbers');
  problems += refused(@() plant.rhs(0, x0, [], {1}), 'real numbers');
end
problems += refused(@() plant.rhs(0, ones(n + 1, 1)), 'rows');
problems += refused(@() plant.rhs(0), 'x is missing');
problems += refused(@() plant.rhs(0, x0, [], [], 1000), 'a mode is a name or a number');
problems += refused(@() plant.rhs(0, x0, [], [], 'no such'), 'there is no mode');
problems += refused(@() plant.rhs(0, single(x0)), 'real numbers');
problems += refused(@() plant.simulate(0), 'ends after it begins');
problems += refused(@() plant.simulate(1, 'magic', 1), 'there is no option');
problems += refused(@() plant.simulate(1, 'method', 'magic'), 'there is no method');
problems += refused(@() plant.simulate(1, 'tolerance', 0), 'tolerance');
if m > 0
  problems += refused(@() plant.simulate(1, 'u', @(t, x) error('mine')), 'mine');
  problems += refused(@() plant.simulate(1, 'u', @(t, x) ones(m + 1, 1)), 'one real number for each');
end

% The run of the program, and handles.
ran = load(paths{3});
warning('off', 'dalembert:stopped');
own = plant.simulate(ran.t_end, 'u', ran.u, 'p', ran.p, 'x0', ran.x0, 'tolerance', 1e-10);
count = min(rows(own.x), rows(ran.x)) - ~own.success;
apart = max(abs(own.x(1:count, :) - ran.x(1:count, :)), [], 1) ./ ran.sizes;
problems += check(count > 1 && max(apart) <= 1e-8, sprintf('the run is %g off that of the program', max(apart)));
if m > 0
  by_function = plant.simulate(ran.t_end / 50, 'u', @(t, x) ran.u, 'p', ran.p, 'x0', ran.x0);
  held = plant.simulate(ran.t_end / 50, 'u', ran.u, 'p', ran.p, 'x0', ran.x0);
  problems += check(isequaln(by_function.x, held.x) && isequaln(by_function.u, held.u), 'inputs by a function');
end
[f, J] = plant.ode(ran.u, ran.p);
problems += check(isequaln(f(0, ran.x0), plant.rhs(0, ran.x0, ran.u, ran.p)) && isequaln(J(0, ran.x0), plant.jacobian_x(0, ran.x0, ran.u, ran.p)), 'handles');
if isempty(plant.modes) && isempty(plant.guards) && ran.peers
  t_end = ran.t_end / 20;
  near = plant.simulate(t_end, 'u', ran.u, 'p', ran.p, 'x0', ran.x0);
  best = Inf;  % unstable motion needs the tight tolerance; a motion at rest has roundings that fail it
  for tolerance = [1e-6, 1e-8]
    if best < 1e-3, break; end
    scale = tolerance * max(abs(near.x), [], 1)' + 1e-12;
    try
      [~, x] = ode15s(f, [0, t_end / 2, t_end], ran.x0, odeset('RelTol', tolerance, 'AbsTol', scale, 'Jacobian', J));
      best = min(best, max(abs(x(end, :)' - near.x_end) ./ max(1e-6, max(abs(near.x), [], 1)')));
    catch e
      disp(e.message);
    end
  end
  problems += check(best < 1e-3, sprintf('ode15s is %g off', best));
end
exit(problems > 0);
