#include "host/pictures/commands.hpp"
#include "host/tool/program.hpp"

namespace {

std::vector<verp::tool::Subcommand> commands(CLI::App& root) {
  return {verp::pictures::add_shot(root), verp::pictures::add_video(root)};
}

}  // namespace

/// `verp shot` and `verp video`: a program of its own, so that `verp` needs no OpenGL.
int main(int argc, char** argv) {
  return verp::tool::run_program(argc, argv, commands);
}
