% VERP_RATE Control ticks a second of CPU time, one call a tick, without physics, over what the controller saw in a
% walk: so many numbers. An error: it decided otherwise than in the walk.
function ticks_s = verp_rate(times)
  session = verp.Session();
  session.add('walk_s', 2);
  saw = {};
  while session.tick()
    seen = session.seen();
    saw{end + 1} = seen.inputs;  %#ok<AGROW>
  end
  core = verp.Core();
  ticks_s = zeros(1, times);
  for n = 1:times
    core.reset();
    start_s = cputime();
    for i = 1:numel(saw)
      outputs = core.step(saw{i});
    end
    ticks_s(n) = numel(saw) / (cputime() - start_s);
    assert(isequal(outputs.goal_count, seen.outputs.goal_count));
    assert(core.digest() == session.digest(), 'the controller did not decide what it did in the walk');
  end
  session.close();
  core.close();
end
