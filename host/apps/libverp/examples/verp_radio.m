function verp_radio(trace)
%VERP_RADIO(TRACE) One robot sends orders by radio and the other obeys them; they share nothing
% else.
  if nargin < 1, trace = ''; end

  function obey(robot, order)
    session.command(order, [0.1 * strcmp(order, 'walk'), 0, 0], [0 0], robot);
  end

  session = verp.Session();
  leader = session.add('walk_s', 0, 'seed', 1);
  if isempty(trace)
    follower = session.add('walk_s', 0, 'seed', 2, 'y_m', 1.5);
  else
    follower = session.add('walk_s', 0, 'seed', 2, 'y_m', 1.5, 'record', trace);
  end
  session.radio('loss', 0.3, 'range_m', 20);
  said = 0; heard = 0; next_s = 0; now_s = 0; doing = '';
  while now_s < 12
    session.tick();
    seen = session.seen(leader);
    now_s = seen.time_s;
    if now_s > 6 && now_s < 10, wanted = 'walk'; else, wanted = 'stand'; end
    if ~strcmp(wanted, doing)
      doing = wanted;
      obey(leader, doing);
    end
    if now_s >= next_s  % repeated, because three in ten are lost
      next_s = next_s + 0.2;
      said = said + session.send(doing, -1, leader);
    end
    [order, from] = session.take(follower);
    while from >= 0
      heard = heard + (from == leader);
      obey(follower, char(order));
      [order, from] = session.take(follower);
    end
  end
  follows = session.seen(follower);
  fprintf('said %d, heard %d; the leader walked %.2f m, the other one %.2f m\n', said, heard, ...
          seen.truth.body_m(1), follows.truth.body_m(1));
  session.close();
  if heard == 0 || heard >= said || follows.truth.body_m(1) < 0.2
    error('verp:radio', 'the follower did not follow');
  end
end
