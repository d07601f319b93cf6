% Pictures in MATLAB and Octave: arrays as these have pictures, and what is said to misuse.
function pictures_test()
  session = verp.Session('demo');
  session.add('walk_s', 1);
  camera = session.cameras();
  assert(strcmp(camera.name, 'camera') && strcmp(camera.gives, 'colour') && camera.width == 320);
  assert(abs(camera.matrix(1, 3) - 159.5) < 1e-9 && camera.matrix(3, 3) == 1);
  assert(max(max(abs(camera.pose(1:3, 1:3)' * camera.pose(1:3, 1:3) - eye(3)))) < 1e-9);
  assert(isempty(session.picture()), 'before the first tick nothing has been seen');
  session.tick(30);
  [seen, time_s] = session.picture('colour');
  tick = session.seen();
  assert(isequal(size(seen), [240 320 3]) && isa(seen, 'uint8') && time_s <= tick.time_s);

  % Turned as they should be: the floor is below, its colour another one than what is above.
  above = mean(mean(double(seen(1:40, :, 2))));
  below = mean(mean(double(seen(201:240, :, 2))));
  aside = mean(mean(double(seen(:, 1:40, 2))));
  assert(abs(above - below) > 3 || abs(above - aside) > 3);
  front = session.render('front', 64, 48);
  assert(isequal(size(front), [48 64 3]) && isequal(front, session.render('front', 64, 48)));
  assert(~isequal(front, session.render({[2 -2 1], [0 0 0.25], 0.5}, 64, 48)));
  assert(~isequal(front, session.render('front', 64, 48, 0, true)), 'plain is another picture');

  says(@() session.picture('heat'), 'takes colour, depth or labels');
  says(@() session.picture('depth'), 'verp_session_picture: camera ''camera'' gives colour');
  says(@() session.picture('colour', 3), 'verp_session_camera: there is no camera 3');
  says(@() session.cameras(2), 'verp_session_cameras: there is no robot 2');
  says(@() session.render('moon', 64, 48), 'verp_session_render: there is no view ''moon''');
  says(@() session.render('front', 1, 48), 'verp_session_render: view->width may be');
  says(@() session.render({[1 2], [0 0 0], 0.5}, 64, 48), 'eye: three numbers');
  says(@() session.render(3), 'the name of a view');
  session.close();
  says(@() session.picture(), 'no handle');
  fprintf('pictures: all is well\n');
end
