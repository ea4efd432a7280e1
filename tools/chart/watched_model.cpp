#include "tools/chart/watched_model.h"

namespace argil::chart {

namespace {

class WatchedModel : public fem::ForceModel {
 public:
  WatchedModel(std::unique_ptr<fem::ForceModel> model, std::function<void()> check)
      : model_(std::move(model)), check_(std::move(check)) {}

  std::string_view name() const override { return model_->name(); }
  fem::Promises promises() const override { return model_->promises(); }
  double energy(const Eigen::Matrix3Xd& x) const override { return model_->energy(x); }
  void forces(const Eigen::Matrix3Xd& x, Eigen::Matrix3Xd& forces) const override {
    check_();
    model_->forces(x, forces);
  }
  std::unique_ptr<fem::Tangent> tangent(const Eigen::Matrix3Xd& x, fem::Projection projection) const override {
    check_();
    return model_->tangent(x, projection);
  }
  void velocity_forces(const Eigen::Matrix3Xd& x, const Eigen::Matrix3Xd& v,
                       Eigen::Matrix3Xd& forces) const override {
    model_->velocity_forces(x, v, forces);
  }

 private:
  std::unique_ptr<fem::ForceModel> model_;
  std::function<void()> check_;
};

}  // namespace

std::unique_ptr<fem::ForceModel> watched(std::unique_ptr<fem::ForceModel> model, std::function<void()> check) {
  return std::make_unique<WatchedModel>(std::move(model), std::move(check));
}

}  // namespace argil::chart
