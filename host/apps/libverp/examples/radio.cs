// radio.exe [TRACE.mcap]: one robot sends orders by radio and the other obeys them; they share nothing else.
using System;
using System.Globalization;
using System.Text;
using Verp;

static class TwoThatTalk {
  static void Obey(Session session, uint robot, string order) {
    bool walks = order == "walk";
    session.Command(walks ? verp_request.VERP_WALK : verp_request.VERP_STAND, walks ? 0.1 : 0, robot: robot);
  }

  static int Main(string[] args) {
    CultureInfo.CurrentCulture = CultureInfo.InvariantCulture;  // 0.5, not 0,5
    using (var session = new Session()) {
      uint leader = session.Add(new Robot { Walk_s = 0, Seed = 1 });
      uint follower = session.Add(new Robot { Walk_s = 0, Seed = 2, Y_m = 1.5, Record = args.Length > 0 ? args[0] : null });
      verp_radio radio = Session.RadioDefaults();
      radio.loss = 0.3;
      radio.range_m = 20;
      session.Radio(radio);
      int said = 0, heard = 0;
      double next_s = 0;
      string doing = "";
      while (session.Seen(leader).time_s < 12) {
        session.Tick();
        double now_s = session.Seen(leader).time_s;
        string wanted = now_s > 6 && now_s < 10 ? "walk" : "stand";
        if (wanted != doing) Obey(session, leader, doing = wanted);
        if (now_s >= next_s) {  // repeated, because three in ten are lost
          next_s += 0.2;
          if (session.Send(Encoding.ASCII.GetBytes(doing), robot: leader)) ++said;
        }
        uint sender;
        for (byte[] order; (order = session.Take(out sender, follower)) != null;) {
          if (sender == leader) ++heard;
          Obey(session, follower, Encoding.ASCII.GetString(order));
        }
      }
      double far_m = session.Seen(leader).truth.body_m[0], follows_m = session.Seen(follower).truth.body_m[0];
      Console.WriteLine("said {0}, heard {1}; the leader walked {2:f2} m, the other one {3:f2} m", said, heard, far_m, follows_m);
      return 0 < heard && heard < said && follows_m > 0.2 ? 0 : 1;
    }
  }
}
