% What the MATLAB and Octave interface says to somebody who looks for a way through. No syntax of one of them alone.
function octave_misuse_test()
  texts_with_a_zero_are_not_cut();
  what_is_no_number_text_or_size_is_named();
  calls_by_hand_are_known();
  outputs_that_are_misspelt_are_named();
  controller_that_closes_leaves_it_open();
  controllers_inside_controllers_keep_their_errors();
  fprintf('octave: all is well\n');
end

function texts_with_a_zero_are_not_cut()
  session = walking();
  cut = @(text) [text, char(0), 'more'];
  says(@() verp.Core(cut('generic21')), 'verp_core_open: model has a zero');
  says(@() verp.Core('generic21', cut('dxl')), 'verp_core_open: bus has a zero');
  says(@() verp.Core('generic21', '', cut('gait.lift_m=0.01')), 'verp_core_open: tuning has a zero');
  says(@() verp.Session(cut('pitch')), 'verp_session_open: world has a zero');
  says(@() add_to_new('model', cut('generic21')), 'verp_session_add: model has a zero');
  says(@() add_to_new('name', cut('a')), 'verp_session_add: name has a zero');
  says(@() add_to_new('record', cut('a.mcap')), 'verp_session_add: record has a zero');
  says(@() session.tune(cut('gait.lift_m'), 0.01), 'verp_session_tune: name has a zero');
  says(@() session.tuning(cut('gait.lift_m')), 'verp_session_tuning: name has a zero');
  says(@() session.read(cut('trunk.mass_kg')), 'verp_session_read: quantity has a zero');
  says(@() session.set(cut('trunk.mass_kg'), 1), 'verp_session_set: quantity has a zero');
  says(@() session.push(cut('trunk'), [1 0 0], 1), 'verp_session_push: thing has a zero');
  says(@() session.render(cut('front')), 'verp_session_render: view has a zero');
  says(@() verp.replay(cut('a.mcap')), 'verp_replay: file has a zero');
  session.close();
end

function what_is_no_number_text_or_size_is_named()
  session = walking();
  core = verp.Core();
  says(@() verp.Core(5), 'verp_core_open: model: a text');
  says(@() verp.Core(['ab'; 'cd']), 'verp_core_open: model: a text');
  says(@() verp.Session('', -1), 'verp_session_open: physics_step_us: -1');
  says(@() session.tick('abc'), 'verp_session_tick: count: one number');
  says(@() session.tick(Inf), 'verp_session_tick: count: inf');
  says(@() session.seen(-1), 'verp_session_seen: robot: -1');
  says(@() session.seen(9), 'verp_session_seen: there is no robot 9');
  says(@() session.emergency_stop('a'), 'verp_session_emergency_stop: pressed');
  session.emergency_stop(false);
  says(@() session.tune(5, 1), 'verp_session_tune: name: a text');
  says(@() session.tune('', 1), 'verp_session_tune: name is null');
  says(@() session.push('trunk', 'abc', 1), 'verp_session_push: force');
  says(@() session.push('trunk', [1 2 NaN], 1), 'verp_session_push: fz_n is not a finite');
  says(@() session.command({}), 'command() takes');
  says(@() session.control(@(inputs, outputs) outputs, NaN), 'control(): own_first');
  says(@() add_to_new('open_end', []), 'add(): open_end');
  says(@() add_to_new('seed', -1), 'verp_session_add: seed: -1');
  says(@() session.picture({'colour', 'depth'}), 'picture() takes');
  says(@() session.render('front', 1e6, 1e6), 'verp_session_render: view->width may be 16 to 8192');
  says(@() session.render({[1 2], [1 2 3], 1}), 'verp_session_render: eye: three numbers');
  says(@() core.plan([0 0 0], -1), 'verp_core_plan: ticks: -1');
  says(@() core.plan([0 0 0], 2 ^ 31), 'verp_core_plan: count is 2147483648: at most 1000000 ticks');
  says(@() core.leg_ik(0, 2 * eye(4)), 'verp_core_leg_ik: sole''s first nine numbers are no rotation');
  says(@() core.leg_ik(0, repmat('a', 4, 4)), 'verp_core_leg_ik: sole: real doubles');
  says(@() core.forward('abc'), 'verp_core_forward: angle_rad: real doubles');
  core.close();
  session.close();
end

% verp_mex is not for people, but they can call it.
function calls_by_hand_are_known()
  session = walking();
  says(@() verp_mex(), 'no such call');
  says(@() verp_mex('session_tick'), 'verp_session_tick: that is no handle');
  says(@() verp_mex('session_tick', session.session, 1, 5), 'verp_session_tick: controllers');
  says(@() verp_mex('core_step', session.session, struct()), 'verp_core_step: this core was closed, or never was one');
  session.control(@(inputs, outputs) outputs, true);
  says(@() verp_mex('session_tick', session.session, 1), 'the controller of robot 0 is missing');
  session.close();
end

function outputs_that_are_misspelt_are_named()
  session = walking();
  session.control(@(inputs, outputs) struct('goal_cuont', 1), true);
  says(@() session.tick(), 'the controller of robot 0: outputs has no field ''goal_cuont''');
  session.close();
end

function controller_that_closes_leaves_it_open()
  session = walking();
  session.control(@(inputs, outputs) closing(session, outputs), true);
  assert(session.tick(3));
  seen = session.seen();
  assert(seen.inputs.tick >= 2, 'what it writes into is there');
  session.close();
  says(@() session.tick(), 'verp_session_tick: that is no handle: it was closed');
end

function outputs = closing(session, outputs)
  says(@() session.close(), 'verp_session_close: another thread, or a callback''s caller');
end

function controllers_inside_controllers_keep_their_errors()
  inner = walking();
  outer = walking();
  inner.control(@(inputs, outputs) error('of the inner one'), true);
  outer.control(@(inputs, outputs) ticking(inner, outer, outputs), true);
  assert(outer.tick(1), 'the outer one has caught all');
  outer.close();
  inner.close();
end

function outputs = ticking(inner, outer, outputs)
  says(@() outer.tick(-1), 'verp_session_tick: count: -1');
  says(@() outer.tick(), 'verp_session_tick: another thread, or a callback''s caller');
  says(@() inner.tick(), 'verp_session_tick: the controller of robot 0: of the inner one');
end

function session = walking()
  session = verp.Session();
  session.add('walk_s', 1);
end

function add_to_new(varargin)
  session = verp.Session();
  session.add(varargin{:});
end
