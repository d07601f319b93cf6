#include <cstddef>
#include <cstdio>
#include <map>

#include "hal/chip/semihosting/semihosting.hpp"

/// For RISC-V, Debian has only the headers of the C++ library. These trees of std::map and std::set
/// are never balanced.
extern "C" void* _sbrk(std::ptrdiff_t bytes);
extern "C" void* sbrk(std::ptrdiff_t bytes) {
  return _sbrk(bytes);
}

extern "C" int getpid() {
  return 1;
}
extern "C" int kill(int, int) {
  return -1;
}
namespace {
int put(char letter, FILE*) {
  const char text[2] = {letter, 0};
  verp::hal::semihosting::print(text);
  return letter;
}
FILE console = FDEV_SETUP_STREAM(put, nullptr, nullptr, _FDEV_SETUP_WRITE);
}  // namespace
FILE* const stderr = &console;

namespace std {
namespace {

using Node = _Rb_tree_node_base;

/// toward/away are left/right or the reverse.
Node* neighbour(Node* node, Node* Node::*toward, Node* Node::*away) {
  if (node->*toward != nullptr) {
    for (node = node->*toward; node->*away != nullptr;) node = node->*away;
    return node;
  }
  Node* parent = node->_M_parent;
  for (; node == parent->*toward; parent = parent->_M_parent) node = parent;
  // The header is its root's parent and child.
  return node->*toward != parent ? parent : node;
}

/// `heir` may be null.
void replace(Node* node, Node* heir, Node& header) {
  Node* const parent = node->_M_parent;
  if (parent == &header) {
    header._M_parent = heir;
  } else if (parent->_M_left == node) {
    parent->_M_left = heir;
  } else {
    parent->_M_right = heir;
  }
  if (heir != nullptr) heir->_M_parent = parent;
}

}  // namespace

Node* _Rb_tree_increment(Node* node) throw() {
  return neighbour(node, &Node::_M_right, &Node::_M_left);
}
const Node* _Rb_tree_increment(const Node* node) throw() {
  return _Rb_tree_increment(const_cast<Node*>(node));
}
Node* _Rb_tree_decrement(Node* node) throw() {
  // The end is the header: red, and its root's parent.
  if (node->_M_color == _S_red && node->_M_parent != nullptr &&
      node->_M_parent->_M_parent == node) {
    return node->_M_right;
  }
  return neighbour(node, &Node::_M_left, &Node::_M_right);
}
const Node* _Rb_tree_decrement(const Node* node) throw() {
  return _Rb_tree_decrement(const_cast<Node*>(node));
}

void _Rb_tree_insert_and_rebalance(const bool left, Node* node, Node* parent,
                                   Node& header) throw() {
  node->_M_parent = parent;
  node->_M_left = node->_M_right = nullptr;
  node->_M_color = _S_black;  // only the header is red
  if (parent == &header) {
    header._M_parent = header._M_left = header._M_right = node;
  } else if (left) {
    parent->_M_left = node;
    if (parent == header._M_left) header._M_left = node;
  } else {
    parent->_M_right = node;
    if (parent == header._M_right) header._M_right = node;
  }
}

Node* _Rb_tree_rebalance_for_erase(Node* const node, Node& header) throw() {
  Node* const before = node == header._M_left ? &header : _Rb_tree_decrement(node);
  Node* const after = node == header._M_right ? &header : _Rb_tree_increment(node);
  if (node->_M_left == nullptr) {
    replace(node, node->_M_right, header);
  } else if (node->_M_right == nullptr) {
    replace(node, node->_M_left, header);
  } else {  // the next node has no left child and replaces it
    if (after->_M_parent != node) {
      replace(after, after->_M_right, header);
      after->_M_right = node->_M_right;
      after->_M_right->_M_parent = after;
    }
    replace(node, after, header);
    after->_M_left = node->_M_left;
    after->_M_left->_M_parent = after;
  }
  if (node == header._M_left) header._M_left = after;
  if (node == header._M_right) header._M_right = before;
  return node;
}

}  // namespace std
