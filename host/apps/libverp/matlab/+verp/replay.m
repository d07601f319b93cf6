function [digest, ticks] = replay(trace)
%VERP.REPLAY Runs the controller again on the inputs of a trace.
%   [digest, ticks] = verp.replay('a.mcap')
% returns the digest, uint64; if a bit differs, the error says where.
  [digest, ticks] = verp_mex('replay', trace);
end
