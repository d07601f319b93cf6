#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <string>

#include "host/os/link/latency.hpp"
#include "host/os/link/line_rate.hpp"
#include "host/os/link/link.hpp"
#include "tests/contract/pc/link_pairs.hpp"

namespace verp::link {
namespace {

using Kind = LinkError::Kind;

LinkError failure(const std::string& text) {
  try {
    Link link(parse_endpoint(text));
  } catch (const LinkError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    EXPECT_NE(std::string(error.what()).find(';'), std::string::npos) << error.what();
    return error;
  }
  ADD_FAILURE() << text << " was opened";
  return {Kind::kUnsuitable, ""};
}

TEST(Open, NamesADeviceThatIsNotThere) {
  EXPECT_EQ(failure("serial:/dev/ttyUSB99@2000000").kind(), Kind::kNoDevice);
  EXPECT_EQ(failure("unix:/tmp/verp-nobody").kind(), Kind::kNoDevice);
  EXPECT_EQ(failure("tcp:no-such-host.invalid:6000").kind(), Kind::kNoDevice);
  EXPECT_EQ(failure("unix-listen:/no/such/folder/s").kind(), Kind::kNoDevice);
}

TEST(Open, NamesWhatIsNoSerialPort) {
  EXPECT_EQ(failure("serial:/etc/passwd@2000000").kind(), Kind::kUnsuitable);
  EXPECT_EQ(failure("serial:/dev/null@2000000").kind(), Kind::kUnsuitable);
  EXPECT_EQ(failure("serial:/tmp@2000000").kind(), Kind::kUnsuitable);
}

TEST(Open, NamesAPeerThatDoesNotListen) {
  std::string address;
  {
    const Link listener(parse_endpoint("tcp-listen:0"));
    address = listener.place();
  }
  EXPECT_EQ(failure(address).kind(), Kind::kRefused);
}

TEST(Open, NamesASecondCopy) {
  const test::Folder folder;
  const Link terminal(parse_endpoint("pty:" + folder.link()));
  const std::string serial = "serial:" + folder.link() + "@2000000";
  {
    const Link first(parse_endpoint(serial));
    const LinkError error = failure(serial);
    EXPECT_EQ(error.kind(), Kind::kBusy);
    EXPECT_NE(std::string(error.what()).find("fuser"), std::string::npos);
  }
  const Link next(parse_endpoint(serial));  // the first is closed
  EXPECT_TRUE(next.connected());
}

TEST(Open, NamesASecondListener) {
  const test::Folder folder;
  const Link first(parse_endpoint("unix-listen:" + folder.link()));
  EXPECT_EQ(failure("unix-listen:" + folder.link()).kind(), Kind::kBusy);
  const Link tcp(parse_endpoint("tcp-listen:0"));
  EXPECT_EQ(failure("tcp-listen" + tcp.place().substr(3)).kind(), Kind::kBusy);
}

// "Another program listens there" would send the user to look for one.
TEST(Open, SaysThatAPathIsNoSocket) {
  const test::Folder folder;
  std::ofstream(folder.link()) << "mine";
  const LinkError error = failure("unix-listen:" + folder.link());
  EXPECT_EQ(error.kind(), Kind::kUnsuitable);
  EXPECT_NE(std::string(error.what()).find("no socket"), std::string::npos) << error.what();
}

TEST(Open, LetsNobodyOfTheNetworkInWithoutTheSecret) {
  for (const char* open : {"tcp-listen:0.0.0.0:0", "tcp-listen:[::]:0"})
    EXPECT_THROW(Link(parse_endpoint(open)), EndpointError) << open;
  const test::Folder folder;
  const std::string token = ",token=" + folder.link();
  std::ofstream(folder.link()) << "too short\n";
  EXPECT_THROW(Link(parse_endpoint("tcp-listen:0.0.0.0:0" + token)), EndpointError);
  std::ofstream(folder.link()) << "0123456789abcdef0123456789abcdef\n";
  Link listener(parse_endpoint("tcp-listen:0.0.0.0:0" + token));
  const std::string place = listener.place(),
                    with = "tcp:127.0.0.1" + place.substr(place.rfind(':'));
  const std::string without = with.substr(0, with.find(','));
  const Link silent(parse_endpoint(without));
  EXPECT_FALSE(listener.wait_connected(100'000));
  Link guessing(parse_endpoint(without));
  const std::string guess = "0123456789abcdef0123456789abcdeg\n";
  guessing.write(reinterpret_cast<const std::uint8_t*>(guess.data()), guess.size(), 1000);
  Link peer(parse_endpoint(with));
  EXPECT_TRUE(listener.wait_connected(5'000'000)) << "the silent peer is sent away";
  const std::uint8_t sent[] = {1, 2, 3};
  EXPECT_EQ(peer.write(sent, 3, 1000), 3u);
  std::uint8_t got[4] = {};
  EXPECT_EQ(listener.read(got, 4, 1'000'000), 3u) << "of the peer with the secret, without it";
  EXPECT_EQ(got[0], 1);
}

// Root may open anything, so the test drops its rights.
TEST(Open, NamesAMissingPermission) {
  const Link terminal(parse_endpoint("pty:"));
  ASSERT_EQ(::chmod(terminal.place().c_str(), 0), 0);
  const uid_t user = ::geteuid();
  ASSERT_TRUE(user != 0 || ::seteuid(65534) == 0);
  const LinkError error = failure("serial:" + terminal.place() + "@2000000");
  ASSERT_TRUE(user != 0 || ::seteuid(0) == 0);
  EXPECT_EQ(error.kind(), Kind::kPermission);
  EXPECT_NE(std::string(error.what()).find("dialout"), std::string::npos);
}

TEST(Open, TakesTheSocketOfAProgramThatWasKilled) {
  const test::Folder folder;
  {
    Link first(parse_endpoint("unix-listen:" + folder.link()));
    ASSERT_EQ(::rename(folder.link().c_str(), (folder.link() + "-kept").c_str()), 0);
  }
  ASSERT_EQ(::rename((folder.link() + "-kept").c_str(), folder.link().c_str()), 0);
  const Link second(parse_endpoint("unix-listen:" + folder.link()));
  EXPECT_FALSE(second.connected());
}

TEST(Open, NeverReplacesAFileByATerminal) {
  const test::Folder folder;
  std::ofstream(folder.link()) << "mine";
  EXPECT_EQ(failure("pty:" + folder.link()).kind(), Kind::kBusy);
  ::unlink(folder.link().c_str());
  ASSERT_EQ(::symlink("/etc/hostname", folder.link().c_str()), 0);
  EXPECT_EQ(failure("pty:" + folder.link()).kind(), Kind::kBusy);
}

std::string target(const std::string& link) {
  char name[64] = {};
  return ::readlink(link.c_str(), name, sizeof name - 1) > 0 ? name : "";
}

TEST(Open, NeverTakesATerminalThatIsServed) {
  const test::Folder folder;
  const Link first(parse_endpoint("pty:" + folder.link()));
  const std::string served = target(folder.link());
  Link peer(parse_endpoint("serial:" + folder.link() + "@2000000"));
  const LinkError error = failure("pty:" + folder.link());
  EXPECT_EQ(error.kind(), Kind::kBusy);
  EXPECT_NE(std::string(error.what()).find("another program serves it"), std::string::npos);
  EXPECT_EQ(target(folder.link()), served);
  std::uint8_t byte = 0;
  EXPECT_EQ(peer.read(&byte, 1, 1000), 0u);
  EXPECT_TRUE(peer.connected());
}

TEST(Open, TakesTheTerminalOfAProgramThatWasKilled) {
  const test::Folder folder;
  ASSERT_EQ(::symlink("/dev/pts/99999999", folder.link().c_str()), 0);
  std::string name;
  {
    const Link link(parse_endpoint("pty:" + folder.link()));
    name = target(folder.link());
    EXPECT_EQ(::access(name.c_str(), F_OK), 0) << name;
  }
  EXPECT_EQ(target(folder.link()), "") << "removed at its end";
  ASSERT_EQ(::symlink(name.c_str(), folder.link().c_str()), 0);
  const Link again(parse_endpoint("pty:" + folder.link()));  // usually the same number
  EXPECT_EQ(::access(target(folder.link()).c_str(), F_OK), 0);
}

TEST(Open, RemovesNoLinkButItsOwn) {
  const test::Folder folder;
  const Link other(parse_endpoint("pty:"));
  {
    const Link link(parse_endpoint("pty:" + folder.link()));
    ASSERT_EQ(::unlink(folder.link().c_str()), 0);
    ASSERT_EQ(::symlink(other.place().c_str(), folder.link().c_str()), 0);
  }
  EXPECT_EQ(target(folder.link()), other.place());
  ::unlink(folder.link().c_str());
  for (const char* elsewhere : {"/dev/pts/", "/dev/pts/../gone", "/dev/pts/9x"}) {
    ASSERT_EQ(::symlink(elsewhere, folder.link().c_str()), 0);
    EXPECT_EQ(failure("pty:" + folder.link()).kind(), Kind::kBusy);
    EXPECT_EQ(target(folder.link()), elsewhere);
    ::unlink(folder.link().c_str());
  }
}

TEST(Open, ATerminalThatCannotBeMadeSaysWhatToDo) {
  const test::Folder folder;
  const auto says = [](const std::string& path, const std::string& words) {
    const std::string what = failure("pty:" + path).what();
    EXPECT_NE(what.find(words), std::string::npos) << what;
  };
  says("/nope/x", "there is no folder /nope/; make it");
  says(folder.link() + "/x", "there is no folder " + folder.link() + "/; make it");
  std::ofstream(folder.link()) << "mine";
  says(folder.link() + "/x", "there is no folder");
  says(folder.link(), "open what is there with serial:" + folder.link());
}

TEST(Open, SetsAnyRate) {
  const Link terminal(parse_endpoint("pty:"));
  for (const char* baud : {"9600", "57600", "1000000", "2000000", "4000000", "4500000", "123457"}) {
    const Link serial(parse_endpoint("serial:" + terminal.place() + "@" + baud));
    const int descriptor = ::open(terminal.place().c_str(), O_RDWR | O_NOCTTY);
    if (descriptor < 0) continue;  // only root passes TIOCEXCL
    EXPECT_EQ(std::to_string(line_rate(descriptor)), baud);
    ::close(descriptor);
  }
}

// A program may open the port before the twin sets the rate.
TEST(Open, ATerminalKeepsTheRateThatItsPeerHasSet) {
  Link found(parse_endpoint("pty:"));
  found.set_rate(2'000'000);
  EXPECT_EQ(found.rate(), 2'000'000U);
  Link taken(parse_endpoint("pty:"));
  const Link early(parse_endpoint("serial:" + taken.place() + "@57600"));
  taken.set_rate(2'000'000);
  EXPECT_EQ(taken.rate(), 57600U);
}

// A USB serial port often returns as another device.
TEST(Reconnect, FindsWhatStandsAtTheSamePath) {
  const test::Folder folder;
  auto terminal = std::make_unique<Link>(parse_endpoint("pty:" + folder.link()));
  Link serial(parse_endpoint("serial:" + folder.link() + "@2000000"));
  std::uint8_t byte = 0;
  for (std::uint32_t plug = 1; plug < 4; ++plug) {
    terminal.reset();
    while (serial.connected()) serial.read(&byte, 1, 10'000);
    EXPECT_FALSE(serial.wait_connected(1000));
    terminal = std::make_unique<Link>(parse_endpoint("pty:" + folder.link()));
    EXPECT_TRUE(serial.wait_connected(5'000'000));
    EXPECT_EQ(serial.errors().losses, plug);
  }
}

TEST(Latency, IsReadAndAdvisedOn) {
  const test::Folder folder;
  const std::string system = folder.link() + "-sys";
  const std::string device = system + "/bus/usb-serial/devices/ttyUSB7";
  ASSERT_EQ(std::system(("mkdir -p " + device).c_str()), 0);
  EXPECT_FALSE(latency_timer_ms("/dev/ttyUSB7", system).has_value());
  EXPECT_EQ(latency_advice("/dev/ttyUSB7", system), "");
  std::ofstream(device + "/latency_timer") << "16\n";
  EXPECT_EQ(latency_timer_ms("/dev/ttyUSB7", system), 16);
  EXPECT_NE(latency_advice("/dev/ttyUSB7", system).find("16 ms; set 1"), std::string::npos);
  std::ofstream(device + "/latency_timer") << "1\n";
  EXPECT_EQ(latency_advice("/dev/ttyUSB7", system), "");
  ASSERT_EQ(std::system(("rm -r " + system).c_str()), 0);
}

}  // namespace
}  // namespace verp::link
