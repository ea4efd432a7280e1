#include "fem/material.h"

#include <gtest/gtest.h>

#include <limits>

#include "subdiv/error.h"

namespace argil::fem {
namespace {

TEST(Material, LameConstantsGiveBackYoungAndPoisson) {
  for (const double nu : {-0.4, 0.0, 0.3, 0.49}) {
    const Lame m = lame(2e5, nu);
    EXPECT_NEAR(m.mu * (3 * m.lambda + 2 * m.mu) / (m.lambda + m.mu), 2e5, 1e-9 * 2e5);
    EXPECT_NEAR(m.lambda / (2 * (m.lambda + m.mu)), nu, 1e-14);
  }
}

TEST(Material, RefusesWhatIsNoSolid) {
  for (const double e :
       {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    EXPECT_THROW((void)lame(e, 0.3), Error) << e;
  for (const double nu : {0.5, 0.6, -1.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW((void)lame(1, nu), Error) << nu;
}

}  // namespace
}  // namespace argil::fem
