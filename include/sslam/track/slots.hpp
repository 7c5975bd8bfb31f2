// SPDX-License-Identifier: BSD-3-Clause
// The slots of a set of stages by name, so that one is replaced in one line:
//
//   using Mine = presets::With<presets::Structure<double>, slots::Rotation<Gyroscope>>;
#pragma once

namespace sslam {

namespace slots {

// Each puts its stage over that of another set.

template <class T>
struct Rotation {
  template <class Base>
  struct Over : Base {
    using Rotation = T;
  };
};

template <class T>
struct Initialisation {
  template <class Base>
  struct Over : Base {
    using Initialisation = T;
  };
};

template <class T>
struct Translation {
  template <class Base>
  struct Over : Base {
    using Translation = T;
  };
};

template <class T>
struct Fallback {
  template <class Base>
  struct Over : Base {
    using Fallback = T;
  };
};

template <class T>
struct Refinement {
  template <class Base>
  struct Over : Base {
    using Refinement = T;
  };
};

template <class T>
struct Keyframes {
  template <class Base>
  struct Over : Base {
    using Keyframes = T;
  };
};

template <class T>
struct Mapping {
  template <class Base>
  struct Over : Base {
    using Mapping = T;
  };
};

template <class T>
struct Loops {
  template <class Base>
  struct Over : Base {
    using Loops = T;
  };
};

template <class T>
struct Upkeep {
  template <class Base>
  struct Over : Base {
    using Upkeep = T;
  };
};

template <class T>
struct Final {
  template <class Base>
  struct Over : Base {
    using Final = T;
  };
};

template <class T>
struct Timer {
  template <class Base>
  struct Over : Base {
    using Timer = T;
  };
};

}  // namespace slots

namespace detail {

template <class Stages, class... Slots>
struct Replaced {
  using Type = Stages;
};

template <class Stages, class First, class... Rest>
struct Replaced<Stages, First, Rest...> : Replaced<typename First::template Over<Stages>, Rest...> {};

}  // namespace detail

}  // namespace sslam
