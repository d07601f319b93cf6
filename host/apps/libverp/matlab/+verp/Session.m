classdef Session < handle
%VERP.SESSION Robots in a world, run one control tick at a time.
%
%   session = verp.Session();             % on a level floor
%   session.add('walk_s', 10);            % generic21, as in `verp walk`
%   while session.tick(1)
%     seen = session.seen();              % its inputs, outputs and true state
%   end
%   result = session.result();
%   session.close();
%
% SI units. World frame: z up, the floor at 0. Robots and joints count from 0. verp.h lists the
% fields of seen() and result(). An error names the call and the reason.
%
% verp.Session(WORLD): a world of common/worlds, or an SDF file. verp.Session(WORLD, STEP_US): with
% a physics step in microseconds (0: 1000).

  properties (SetAccess = private)
    session              % the library's handle
    controllers = struct('function', {}, 'own_first', {})  % one per robot
  end

  methods
    function obj = Session(world, physics_step_us)
      if nargin < 1, world = ''; end
      if nargin < 2, physics_step_us = 0; end
      obj.session = verp_mex('session_open', world, physics_step_us);
    end

    function robot = add(obj, varargin)
    %ADD Adds a robot before the first tick; returns its index. add('model', 'op3', 'bus', '',
    % 'name', '', 'tuning', 'gait.lift_m=0.012', 'record', 'a.mcap', 'seed', 1, 'walk_s', 20,
    % 'vx_m_s', 0.18, 'vy_m_s', 0, 'wz_rad_s', 0, 'x_m', 0, 'y_m', 0, 'yaw_rad', 0, 'open_end',
    % false): every argument is optional. With walk_s = 0 the robot obeys command() alone.
      known = {'model', 'bus', 'name', 'tuning', 'record', 'seed', 'walk_s', 'vx_m_s', 'vy_m_s', ...
               'wz_rad_s', 'x_m', 'y_m', 'yaw_rad', 'open_end'};
      what = named_values('add', known, varargin);
      if isfield(what, 'open_end')
        if ~is_flag(what.open_end)
          error('verp:argument', 'verp: add(): open_end is true or false');
        end
        what.flags = double(what.open_end ~= 0);
      end
      robot = verp_mex('session_add', obj.session, what);
      obj.controllers(robot + 1) = struct('function', [], 'own_first', false);
    end

    function more = tick(obj, count)
    %TICK Runs at most `count` (1) ticks, each of one robot. False: the run has ended.
      if nargin < 2, count = 1; end
      more = verp_mex('session_tick', obj.session, count, obj.controllers);
    end

    function seen = seen(obj, robot)
    %SEEN The robot's last tick: inputs, outputs, joint_rad, goal_rad, truth; see verp_tick.
      if nargin < 2, robot = 0; end
      seen = verp_mex('session_seen', obj.session, robot);
    end

    function result = result(obj, robot)
    %RESULT Ends the runs of all robots; returns the robot's result, see verp_result.
      if nargin < 2, robot = 0; end
      result = verp_mex('session_result', obj.session, robot);
    end

    function digest = digest(obj, robot)
    %DIGEST Of all its ticks so far, uint64.
      if nargin < 2, robot = 0; end
      digest = verp_mex('session_digest', obj.session, robot);
    end

    function command(obj, request, velocity, head_rad, robot)
    %COMMAND Takes control of the robot: 'relax', 'stand', 'get_up' or 'walk', with the velocity
    % [vx m/s, vy m/s, wz rad/s] in its body frame and the head angles [to the left, down] in rad.
      if nargin < 3, velocity = [0 0 0]; end
      if nargin < 4, head_rad = [0 0]; end
      if nargin < 5, robot = 0; end
      request = find(strcmp(char_or_none(request), {'relax', 'stand', 'walk', 'get_up'})) - 1;
      if isempty(request) || numel(velocity) ~= 3 || numel(head_rad) ~= 2
        error('verp:argument', 'verp: command() takes relax, stand, walk or get_up, [vx vy wz], [pan tilt]');
      end
      verp_mex('session_command', obj.session, robot, request, velocity(1), velocity(2), ...
               velocity(3), head_rad(1), head_rad(2));
    end

    function give_back(obj, robot)
    %GIVE_BACK Ends the caller's control; the requested walk continues.
      if nargin < 2, robot = 0; end
      verp_mex('session_give_back', obj.session, robot);
    end

    function emergency_stop(obj, pressed, robot)
    %EMERGENCY_STOP While pressed, the robot is limp.
      if nargin < 2, pressed = true; end
      if nargin < 3, robot = 0; end
      verp_mex('session_emergency_stop', obj.session, robot, pressed);
    end

    function control(obj, controller, own_first, robot)
    %CONTROL Replaces the robot's own controller from the next tick on by a function
    %   outputs = controller(inputs, outputs)
    % of structs of counts (verp_inputs, verp_outputs), whose result is sent as it is. The argument
    % `outputs` holds those of the previous tick or, with own_first, the new decision of the robot's
    % own controller. An empty controller restores the robot's own.
      if nargin < 3, own_first = false; end
      if nargin < 4, robot = 0; end
      if ~isempty(controller) && ~isa(controller, 'function_handle')
        error('verp:argument', 'verp: control() takes a function handle, or []');
      end
      if ~is_flag(own_first)
        error('verp:argument', 'verp: control(): own_first is true or false');
      end
      verp_mex('session_control', obj.session, robot, ~isempty(controller));
      trapped = @(inputs, outputs) verp.tried(controller, inputs, outputs);
      obj.controllers(robot + 1) = struct('function', {trapped}, 'own_first', own_first ~= 0);
    end

    function tune(obj, name, value, robot)
    %TUNE Sets a tuning value (`verp parameters`); it takes effect in one of the next ticks.
      if nargin < 4, robot = 0; end
      verp_mex('session_tune', obj.session, robot, name, value);
    end

    function value = tuning(obj, name, robot)
    %TUNING The tuning value in force.
      if nargin < 3, robot = 0; end
      value = verp_mex('session_tuning', obj.session, robot, name);
    end

    function found = quantities(obj)
    %QUANTITIES The quantities of the physics, after all robots were added: name, unit, what, low,
    % high, settable.
      found = orderfields(verp_mex('session_quantities', obj.session), ...
                          {'name', 'unit', 'what', 'low', 'high', 'settable'});
      for i = 1:numel(found)
        found(i).settable = found(i).settable ~= 0;
      end
    end

    function value = read(obj, quantity)
    %READ A quantity of the physics: 'trunk.mass_kg'.
      value = verp_mex('session_read', obj.session, quantity);
    end

    function set(obj, quantity, value)
    %SET Sets a quantity of the physics from the next step on.
      verp_mex('session_set', obj.session, quantity, value);
    end

    function push(obj, thing, force_n, for_s)
    %PUSH Pushes a link or object at its centre of mass, [x y z] N in world axes.
      if numel(force_n) ~= 3
        error('verp:argument', 'verp: push() takes a force of three numbers');
      end
      verp_mex('session_push', obj.session, thing, force_n(1), force_n(2), force_n(3), for_s);
    end

    function cameras = cameras(obj, robot)
    %CAMERAS The cameras of the robot's file: name, contents ('colour depth'), width, height,
    % rate_hz, matrix (fx 0 cx; 0 fy cy; 0 0 1, in pixels; the middle of the first one is 0),
    % distortion (k1 k2 p1 p2 k3), near_m, far_m, link (index as in core.forward()) and pose in it.
      if nargin < 2, robot = 0; end
      names = {'name', 'gives', 'width', 'height', 'rate_hz', 'matrix', 'distortion', 'near_m', 'far_m', ...
               'link', 'pose'};
      given = verp_mex('session_cameras', obj.session, robot);
      cameras = cell2struct(cell(numel(names), numel(given)), names, 1)';
      for i = 1:numel(given)
        camera = given(i);
        contents = {'colour', 'depth', 'labels'};
        camera.gives = strjoin(contents(bitand(camera.gives, [1 2 4]) ~= 0), ' ');
        camera.matrix = [camera.fx_px, 0, camera.cx_px; 0, camera.fy_px, camera.cy_px; 0 0 1];
        camera.pose = [reshape(camera.pose(1:9), 3, 3)', camera.pose(10:12)'; 0 0 0 1];
        for k = 1:numel(names), cameras(i).(names{k}) = camera.(names{k}); end
      end
    end

    function [pixels, time_s] = picture(obj, what, camera, robot)
    %PICTURE A camera's last picture, up to the robot's last tick, and its time: 'colour' as (row,
    % column, red green blue), uint8; 'depth' in mm (0: nothing) or 'labels' as (row, column),
    % uint16. Empty: none taken yet. Cameras count from 0. The picture is drawn on request; that
    % does not affect the run.
      if nargin < 2, what = 'colour'; end
      if nargin < 3, camera = 0; end
      if nargin < 4, robot = 0; end
      bit = find(strcmp(char_or_none(what), {'colour', 'depth', 'labels'}));
      if isempty(bit)
        error('verp:argument', 'verp: picture() takes colour, depth or labels');
      end
      [pixels, time_s] = verp_mex('session_picture', obj.session, robot, camera, 2 ^ (bit - 1));
    end

    function pixels = render(obj, view, width, height, robot, plain)
    %RENDER The world as it is now, as (row, column, red green blue), uint8. View: front, side,
    % three-quarter, back, top, follow or head of a robot; a camera that a file declares; or {eye,
    % target, fov}, points in m, world frame, and the vertical angle in rad. `plain`: without
    % shadows, and faster.
      if nargin < 2, view = 'follow'; end
      if nargin < 3, width = 640; end
      if nargin < 4, height = 480; end
      if nargin < 5, robot = 0; end
      if nargin < 6, plain = false; end
      if iscell(view) && numel(view) == 3
        pixels = verp_mex('session_render', obj.session, '', width, height, robot, plain, view{:});
      elseif ischar(view) && ~isempty(view)
        pixels = verp_mex('session_render', obj.session, view, width, height, robot, plain);
      else
        error('verp:argument', 'verp: render() takes the name of a view, or {eye, target, fov}');
      end
    end

    function radio(obj, varargin)
    %RADIO Gives each robot a radio, before the first tick: radio('range_m', 30, 'loss', 0.02,
    % 'fade', 0.02, 'fade_s', 0.3, 'delay_s', 0.004, 'jitter_s', 0.004, 'bytes_s', 31250,
    % 'most_bytes', 96, 'most_waiting', 16, 'overhead_bytes', 31, 'seed', 1). Every argument is
    % optional; see verp_radio.
      known = {'range_m', 'loss', 'fade', 'fade_s', 'delay_s', 'jitter_s', 'bytes_s', 'most_bytes', ...
               'most_waiting', 'overhead_bytes', 'seed'};
      what = named_values('radio', known, varargin);
      verp_mex('session_radio', obj.session, what);
    end

    function sent = send(obj, data, to, robot)
    %SEND Sends a message, uint8 or text, from a robot to another one or to all (-1). False: too
    % many messages wait to be sent. There is no acknowledgement.
      if nargin < 3, to = -1; end
      if nargin < 4, robot = 0; end
      if ischar(data), data = uint8(data); end
      sent = verp_mex('session_send', obj.session, robot, to, data);
    end

    function [data, from] = take(obj, robot)
    %TAKE The next message that the robot received up to its last tick, uint8, and its sender.
    % `from` is -1 if there is no message.
      if nargin < 2, robot = 0; end
      [data, from] = verp_mex('session_take', obj.session, robot);
    end

    function close(obj)
    %CLOSE Ends the run and completes its traces. MATLAB's exit does the same.
      if isempty(obj.session), return; end
      try
        verp_mex('session_close', obj.session);
      catch thrown
        if ~strcmp(thrown.identifier, 'verp:busy'), obj.session = []; end  % a controller of it is at work
        rethrow(thrown);
      end
      obj.session = [];
    end

    function delete(obj)
      obj.close();
    end
  end
end

function what = named_values(call, known, given)
  if mod(numel(given), 2) ~= 0
    error('verp:argument', 'verp: %s() takes names and values', call);
  end
  what = struct();
  for i = 1:2:numel(given)
    if ~ischar(given{i}) || ~any(strcmp(given{i}, known))
      error('verp:argument', 'verp: %s() knows: %s', call, strjoin(known, ', '));
    end
    what.(given{i}) = given{i + 1};
  end
end

function yes = is_flag(value)
  yes = (islogical(value) || isnumeric(value)) && isscalar(value) && isreal(value) && ~isnan(value);
end

function text = char_or_none(value)
  text = '';
  if ischar(value), text = value; end
end
