classdef Core < handle
%VERP.CORE The controller of one robot, without a world, bit for bit as on the robot.
%
%   core = verp.Core('generic21');
%   outputs = core.step(struct('tick', 0));   % missing fields are 0; see verp_inputs
%   [angles, flags] = core.leg_ik(0, pose);
%
% verp.Core(MODEL, BUS, TUNING): a robot of common/robots or an SDF file; one of its buses ('': the
% first); 'gait.lift_m=0.012 ...'. Joints and sides count from 0, as in verp.h; side 0 is left. Poses
% are 4x4 matrices in the body frame: origin at the trunk's centre, x forward, y left, z up.

  properties (SetAccess = private)
    core         % the library's handle
    joint_names  % cell of texts
    period_s     % control period
  end

  methods
    function obj = Core(model, bus, tuning)
      if nargin < 1, model = 'generic21'; end
      if nargin < 2, bus = ''; end
      if nargin < 3, tuning = ''; end
      obj.core = verp_mex('core_open', model, bus, tuning);
      obj.joint_names = verp_mex('core_names', obj.core);
      obj.period_s = verp_mex('core_period', obj.core);
    end

    function reset(obj)
    %RESET Returns to the state at power-on.
      verp_mex('core_reset', obj.core);
    end

    function outputs = step(obj, inputs)
    %STEP Runs one control tick: takes a struct like verp_inputs, returns one like verp_outputs.
      outputs = verp_mex('core_step', obj.core, inputs);
    end

    function digest = digest(obj)
    %DIGEST Of all ticks since power-on, uint64.
      digest = verp_mex('core_digest', obj.core);
    end

    function count = count(obj, joint, angle_rad)
    %COUNT Servo count for a joint angle.
      count = verp_mex('core_count', obj.core, joint, angle_rad);
    end

    function angle_rad = angle(obj, joint, count)
    %ANGLE Joint angle for a servo count.
      angle_rad = verp_mex('core_angle', obj.core, joint, count);
    end

    function poses = forward(obj, angle_rad)
    %FORWARD Forward kinematics: 4 x 4 x (joints + 1), the body first, then the link of each joint.
      rows = verp_mex('core_forward', obj.core, angle_rad);
      poses = zeros(4, 4, size(rows, 2));
      for i = 1:size(rows, 2)
        poses(:, :, i) = [reshape(rows(1:9, i), 3, 3)', rows(10:12, i); 0 0 0 1];
      end
    end

    function com_m = com(obj, angle_rad)
    %COM Centre of mass in the body frame.
      com_m = verp_mex('core_com', obj.core, angle_rad);
    end

    function [angle_rad, flags] = leg_ik(obj, side, sole)
    %LEG_IK Six angles, hip to ankle, that bring the sole of a leg to a pose. Flags: 1 out of
    % reach, 2 a joint at its limit, 4 not converged.
      if ~isequal(size(sole), [4 4])
        error('verp:argument', 'verp: leg_ik() takes the sole''s pose as a 4x4 matrix');
      end
      found = verp_mex('core_leg_ik', obj.core, side, ...
                       [reshape(sole(1:3, 1:3)', 1, 9), sole(1:3, 4)']);
      angle_rad = found(1:6);
      flags = found(7);
    end

    function plan = plan(obj, velocity, ticks, stop)
    %PLAN Plans so many ticks of gait from standing with velocity [vx vy wz], the last `stop` of
    % them after a stop order. Returns a struct array, see verp_plan.
      if nargin < 4, stop = 0; end
      if numel(velocity) ~= 3
        error('verp:argument', 'verp: plan() takes a velocity of three numbers');
      end
      plan = verp_mex('core_plan', obj.core, velocity(1), velocity(2), velocity(3), ticks, stop);
    end

    function close(obj)
    %CLOSE Closes the handle.
      if ~isempty(obj.core)
        open = obj.core;
        obj.core = [];
        verp_mex('core_close', open);
      end
    end

    function delete(obj)
      obj.close();
    end
  end
end
