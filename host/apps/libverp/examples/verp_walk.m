function verp_walk(seconds)
%VERP_WALK(SECONDS) The walk of `verp walk`, and its digest.
  if nargin < 1, seconds = 20; end
  session = verp.Session();
  session.add('walk_s', seconds);
  while session.tick(100), end
  result = session.result();
  fprintf('%.2f m 0x%016x\n', result.distance_m, result.digest);
  session.close();
end
