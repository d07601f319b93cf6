% The MATLAB and Octave interface: its bits, its speed, and what it says to misuse. No syntax of one of them alone.
function octave_test()
  core_steps_what_a_session_saw();
  own_controller_is_in_force();
  kinematics_come_back();
  misuse_is_an_error_that_names_the_call();
  controller_that_errs_ends_the_call_alone();
  robots_talk_by_radio();
  fprintf('octave: all is well\n');
end

% With 2,000 ticks a second of CPU time, one call a tick.
function core_steps_what_a_session_saw()
  ticks_s = verp_rate(1);
  fprintf('%.0f ticks/s\n', ticks_s);
  assert(ticks_s >= 2000, 'too slow');
end

function own_controller_is_in_force()
  session = verp.Session();
  session.add('walk_s', 1);
  session.tick(50);
  session.control(@(inputs, outputs) setfield(outputs, 'torque_enable', 0));  %#ok<SFLD>
  session.tick(5);
  seen = session.seen();
  assert(seen.outputs.torque_enable == 0);
  session.control([]);
  session.tick(5);
  seen = session.seen();
  assert(seen.outputs.torque_enable ~= 0);
  session.close();
end

function kinematics_come_back()
  core = verp.Core();
  assert(numel(core.joint_names) == 21 && core.period_s > 0.001);
  sole = eye(4);
  plan = core.plan([0.1 0 0], 200);
  sole(1:3, 1:3) = reshape(plan(end).left_sole(1:9), 3, 3)';
  sole(1:3, 4) = plan(end).left_sole(10:12)';
  [angles, flags] = core.leg_ik(0, sole);
  assert(flags == 0 && max(abs(angles - plan(end).leg_rad(1:6))) < 1e-3);
  assert(isequal(size(core.forward(zeros(1, 21))), [4 4 22]));
  assert(abs(core.angle(3, core.count(3, 0.5)) - 0.5) < 0.01);
  core.close();
end

function misuse_is_an_error_that_names_the_call()
  session = verp.Session();
  says(@() session.tick(), 'verp_session_tick');  % no robot yet
  says(@() session.add('colour', 1), 'add() knows');
  says(@() session.add('seed'), 'names and values');
  says(@() session.add('model', 'nobody'), 'nobody');
  says(@() session.add('walk_s', [1 2]), 'walk_s: 1 real double');
  says(@() session.add('walk_s', NaN), 'walk_s: nan does not fit');
  session.add('walk_s', 1);
  says(@() session.read('moon'), 'moon');
  says(@() session.seen(3), 'verp_session_seen: there is no robot 3');
  says(@() session.tick(-1), 'is no count');
  says(@() session.push('trunk', 1, 1), 'three numbers');
  says(@() session.command('jump'), 'relax, stand, walk or get_up');
  says(@() session.control(3), 'function handle');
  core = verp.Core();
  says(@() core.forward([1 2 3]), 'verp_core_forward');
  says(@() core.leg_ik(0, [1 2 3]), '4x4');
  says(@() core.step(3), 'a struct of inputs');
  says(@() core.step(struct('position_count', [1 2])), 'position_count: 32');
  says(@() core.step(struct('tick', -1)), 'does not fit');
  says(@() core.step(struct('tick', 1.5)), 'tick: 1.5 is no whole number');
  says(@() core.count(0.5, 0), 'joint: 0.5 is no count');
  says(@() core.angle(0, 2048.5), 'count: 2048.5 is no whole number');
  says(@() core.leg_ik(0.5, eye(4)), 'side: 0.5 is no count');
  says(@() core.count(0, NaN), 'angle_rad is not a finite number');
  angles = zeros(1, 21);
  angles(3) = NaN;
  says(@() core.forward(angles), 'angle_rad[2] is not a finite number');
  says(@() core.com(angles), 'angle_rad[2]');
  sole = eye(4);
  sole(3, 4) = Inf;
  says(@() core.leg_ik(0, sole), 'sole[11]');
  says(@() session.tick(1.5), 'count: 1.5 is no count');
  core.close();
  core.close();
  closed = {@() core.step(struct()), @() core.reset(), @() core.digest(), @() core.forward(zeros(1, 21)), ...
            @() core.com(zeros(1, 21)), @() core.leg_ik(0, eye(4)), @() core.plan([0 0 0], 5), @() core.count(0, 0), ...
            @() core.angle(0, 0)};
  for i = 1:numel(closed)
    says(closed{i}, 'it was closed');
  end
  session.close();
  session.close();
  says(@() session.tick(), 'it was closed');
  says(@() verp_mex('session_close', uint64(12345)), 'verp_session_close');
  says(@() verp_mex('dance'), 'no such call');
  says(@() verp_mex(), 'no such call');
  says(@() verp.replay('/nowhere.mcap'), '/nowhere.mcap');
end

function controller_that_errs_ends_the_call_alone()
  session = verp.Session();
  session.add('walk_s', 1);
  session.control(@(inputs, outputs) error('on purpose'));
  says(@() session.tick(), 'the controller of robot 0: on purpose');
  session.close();
  wrong = {7, struct('goal_count', zeros(1, 3)), struct('mode', 300), struct('mode', NaN)};
  for i = 1:numel(wrong)
    session = verp.Session();
    session.add('walk_s', 1);
    session.control(@(inputs, outputs) wrong{i});
    says(@() session.tick(), 'the controller of robot 0: ');
    session.close();
  end
end

function robots_talk_by_radio()
  session = verp.Session();
  session.add('walk_s', 1);
  session.add('walk_s', 1, 'y_m', 1);
  says(@() session.radio('colour', 1), 'radio() knows');
  says(@() session.radio('loss', 2), 'loss');
  says(@() session.radio('seed', 0.5), 'seed: 0.5 is no whole number');
  says(@() session.send('x'), 'verp_session_radio() before');
  session.radio('loss', 0, 'fade', 0);
  session.tick(2);
  assert(session.send('hello', 1));
  says(@() session.send([1 2 3]), 'a row of uint8');
  says(@() session.send('x', 0), 'to is 0');
  says(@() session.send('x', 0.5), 'to: 0.5 is no whole number');
  session.tick(20);
  [data, from] = session.take(1);
  assert(strcmp(char(data), 'hello') && from == 0);
  [data, from] = session.take(1);
  assert(isempty(data) && from == -1);
  session.close();
  says(@() session.take(0), 'it was closed');
end
