function verp_tune(seconds)
%VERP_TUNE(SECONDS) Changes a number of the gait and one of the physics during a walk.
  if nargin < 1, seconds = 20; end
  session = verp.Session();
  session.add('walk_s', seconds);
  session.tick(400);
  session.tune('gait.lift_m', 0.015);
  session.set('trunk.mass_kg', 1.02 * session.read('trunk.mass_kg'));
  while session.tick(100), end
  fprintf('lift %.4f m, trunk %.3f kg\n', session.tuning('gait.lift_m'), session.read('trunk.mass_kg'));
  session.close();
end
