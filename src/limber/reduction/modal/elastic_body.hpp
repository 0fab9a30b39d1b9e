// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/fem/solid/elastic_inverse.hpp"
#include "limber/reduction/modal/interfaces.hpp"
#include "limber/reduction/modal/support.hpp"

/// Part of limber_reduction.
namespace limber::flexbody {

/// A body as modes and static responses need it, of a mesh or of matrices.
/// Fields are of all nodes, with the rows that InterfaceMotion expects.
struct ElasticBody {
  ElasticBody(std::string its_source, std::vector<Interface> its_interfaces,
              Support its_support, const Matrix3X& x_free,
              const Progress& progress)
      : source(std::move(its_source)),
        interfaces(std::move(its_interfaces)),
        support(std::move(its_support)),
        inverse(support.matrices, support.R, x_free, progress) {}
  ElasticBody(std::string its_source, std::vector<Interface> its_interfaces,
              Support its_support, double shift, std::string conditioning)
      : source(std::move(its_source)),
        interfaces(std::move(its_interfaces)),
        support(std::move(its_support)),
        inverse(support.matrices, support.R, shift, std::move(conditioning)) {}
  ElasticBody(const ElasticBody&) = delete;  // `inverse` points into `support`
  ElasticBody& operator=(const ElasticBody&) = delete;

  std::string source;  ///< for messages
  std::vector<Interface> interfaces;
  Support support;
  fem::ElasticInverse inverse;  ///< of the free degrees of freedom

 protected:
  ~ElasticBody() = default;
};

}  // namespace limber::flexbody
