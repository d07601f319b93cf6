function verp_camera(file, seconds)
%VERP_CAMERA(FILE, SECONDS) Walks through a room, writes the robot's last view to FILE (.ppm) and
% renders a picture of the robot.
  if nargin < 2, seconds = 20; end
  session = verp.Session('demo');
  session.add('walk_s', seconds);
  while session.tick(100)
  end
  cameras = session.cameras();
  [seen, time_s] = session.picture('colour');
  outside = session.render('follow', 320, 240);
  fprintf('%s: %dx%d at %.2f s, mean %.1f; from outside %.1f\n', cameras(1).name, size(seen, 2), ...
          size(seen, 1), time_s, mean(double(seen(:))), mean(double(outside(:))));
  out = fopen(file, 'w');
  fprintf(out, 'P6\n%d %d\n255\n', size(seen, 2), size(seen, 1));
  fwrite(out, permute(seen, [3 2 1]));
  fclose(out);
  session.close();
end
