function [digest, ticks] = replay(trace)
%VERP.REPLAY Runs the controller once more over what a trace says that it saw.
%   [digest, ticks] = verp.replay('a.mcap')
% gives the digest, uint64; where a bit differs it is an error that says where.
  [digest, ticks] = verp_mex('replay', trace);
end
