function verp_record(file, seconds)
%VERP_RECORD(FILE, SECONDS) Records a walk, and replays it bit for bit.
  if nargin < 2, seconds = 20; end
  session = verp.Session();
  session.add('record', file, 'walk_s', seconds);
  while session.tick(100), end
  session.close();
  [digest, ticks] = verp.replay(file);
  fprintf('%d ticks 0x%016x\n', ticks, digest);
end
