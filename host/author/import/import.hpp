#pragma once
#include <memory>
#include <string>
#include <vector>

#include "host/author/import/finding.hpp"
#include "host/author/import/source.hpp"
#include "host/author/import/wrapper.hpp"
#include "host/robot/model/entity.hpp"
#include "host/robot/model/load_error.hpp"

/// A robot's file of another maker, made to walk: `verp import`.
namespace verp::import {

struct Wish {
  std::string file, folder;     ///< URDF; where robot.sdf will be
  std::string name;             ///< of the robot; empty: the file's
  std::string servo_type;       ///< empty: the weakest that carries the robot
  std::string maker_file = {};  ///< from which `file` was made; empty: `file` itself
  Source source = {};
};

struct Imported {
  std::string name, sdf;
  std::vector<Finding> findings;
  std::vector<std::string> left_out;            ///< one line each
  std::string refusal;                          ///< why the twin does not load it; empty: it loads
  std::shared_ptr<const model::Entity> entity;  ///< as `sdf` is loaded; null: refused
  std::string picture, no_picture;              ///< file beside the page; why there is none
};

/// A file of another format becomes a URDF in the folder, which is then the wish's file. Throws
/// LoadError for what cannot be understood, and where such a URDF is there already.
void make_urdf(Wish& wish);

/// Throws LoadError where the file cannot be understood, or has no two legs of six joints, or of
/// these without hip yaw or ankle roll.
Imported import_robot(const Wish& wish);

/// import.md.
std::string page_of(const Imported& robot, const Wish& wish);

}  // namespace verp::import
