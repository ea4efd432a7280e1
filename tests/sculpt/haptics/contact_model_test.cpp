#include "sculpt/haptics/contact_model.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace argil::sculpt {
namespace {

using Eigen::Vector3d;

TEST(ContactModel, IsLinearAboutItsPointAndPushesOutOfPlanes) {
  ContactModel model;
  model.point = Vector3d(1, 0, 0);
  model.force = Vector3d(0, 0, 2);
  model.derivative = -10 * Eigen::Matrix3d::Identity();
  EXPECT_EQ(contact_force(model, model.point), model.force);
  EXPECT_EQ(contact_force(model, Vector3d(1.5, 0, 0)), Vector3d(-5, 0, 2));
  model.planes[0] = {Vector3d::UnitX(), 1, 1000};
  model.planes[1] = {Vector3d::UnitY(), -1, 500};
  model.plane_count = 2;
  EXPECT_EQ(contact_force(model, Vector3d(1.5, 0, 0)), Vector3d(-5, 0, 2));  // outside both
  EXPECT_EQ(contact_force(model, Vector3d(0.5, 0, 0)), Vector3d(5 + 500, 0, 2));
  EXPECT_EQ(contact_force(model, Vector3d(1, -2, 0)), Vector3d(0, 20 + 500, 2));
}

TEST(ContactChannel, GivesTheNewestOrNothing) {
  ContactChannel channel;
  EXPECT_EQ(channel.latest(), nullptr);
  ContactModel model;
  for (model.valid_until = 1; model.valid_until <= 5; ++model.valid_until) channel.publish(model);
  ASSERT_NE(channel.latest(), nullptr);
  EXPECT_EQ(channel.latest()->valid_until, 5);
  model.valid_until = 9;
  channel.publish(model);
  EXPECT_EQ(channel.latest()->valid_until, 9);
}

TEST(ContactChannel, AReaderNeverSeesHalfAModel) {
  // Every number of a model is its own serial number, so a torn one would show; serial numbers never fall.
  ContactChannel channel;
  constexpr Tick k_models = 20000;
  std::atomic<bool> torn{false}, fell{false};
  std::thread reader([&] {
    Tick last = 0;
    while (last < k_models) {
      const ContactModel* model = channel.latest();
      if (model == nullptr) continue;
      const auto serial = static_cast<double>(model->valid_until);
      bool whole = model->point == Vector3d::Constant(serial) && model->force == Vector3d::Constant(serial) &&
                   model->derivative == Eigen::Matrix3d::Constant(serial);
      for (const ContactPlane& plane : model->planes) whole = whole && plane.offset == serial;
      if (!whole) torn = true;
      if (model->valid_until < last) fell = true;
      last = model->valid_until;
    }
  });
  for (Tick serial = 1; serial <= k_models; ++serial) {
    ContactModel model;
    const auto value = static_cast<double>(serial);
    model.valid_until = serial;
    model.point.setConstant(value);
    model.force.setConstant(value);
    model.derivative.setConstant(value);
    for (ContactPlane& plane : model.planes) plane.offset = value;
    channel.publish(model);
  }
  reader.join();
  EXPECT_FALSE(torn);
  EXPECT_FALSE(fell);
}

}  // namespace
}  // namespace argil::sculpt
