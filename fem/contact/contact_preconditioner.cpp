#include "fem/contact/contact_preconditioner.h"

#include <vector>

#include "fem/parallel.h"

namespace argil::fem {

namespace {

constexpr std::size_t k_most_control_points = 400;
constexpr double k_most_bytes = 256e6;

class WithContact final : public Preconditioner {
 public:
  WithContact(const Preconditioner& inner, PreconditionerColumns& columns, const ContactStep& contact,
              std::vector<std::uint32_t> touched, Eigen::Index count)
      : inner_(inner) {
    for (const std::uint32_t c : touched) columns_.push_back(&columns.of(inner, c, count));
    Eigen::MatrixXd stiffness = contact.stiffness(touched);
    if (columns.last && columns.last->control_points == touched && columns.last->stiffness == stiffness) {
      system_ = columns.last;
      return;
    }
    const Eigen::Index size = stiffness.cols();
    Eigen::MatrixXd compliance(size, size);  // G
    for (Eigen::Index j = 0; j < size; ++j)
      for (std::size_t i = 0; i < touched.size(); ++i)
        for (Eigen::Index axis = 0; axis < 3; ++axis)
          compliance(3 * static_cast<Eigen::Index>(i) + axis, j) =
              (*columns_[static_cast<std::size_t>(j / 3)])(3 * static_cast<Eigen::Index>(touched[i]) + axis, j % 3);
    auto system = std::make_shared<ContactSystem>();
    system->factor.compute(Eigen::MatrixXd::Identity(size, size) + stiffness * compliance);
    system->control_points = std::move(touched);
    system->stiffness = std::move(stiffness);
    columns.last = system_ = std::move(system);
  }

  PreconditionerKind kind() const override { return inner_.kind(); }

  void apply(const Eigen::Matrix3Xd& r, Eigen::Matrix3Xd& z) const override {
    inner_.apply(r, z);
    const std::vector<std::uint32_t>& touched = system_->control_points;
    Eigen::VectorXd there(system_->stiffness.cols());
    for (std::size_t i = 0; i < touched.size(); ++i)
      there.segment<3>(3 * static_cast<Eigen::Index>(i)) = z.col(static_cast<Eigen::Index>(touched[i]));
    const Eigen::VectorXd held = system_->factor.solve(system_->stiffness * there);
    parallel_for(static_cast<std::size_t>(z.cols()), 256, [&](std::size_t c) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (std::size_t i = 0; i < columns_.size(); ++i)
        for (Eigen::Index axis = 0; axis < 3; ++axis)
          sum += held[3 * static_cast<Eigen::Index>(i) + axis] *
                 columns_[i]->col(axis).segment<3>(3 * static_cast<Eigen::Index>(c));
      z.col(static_cast<Eigen::Index>(c)) -= sum;
    });
  }

 private:
  const Preconditioner& inner_;
  std::vector<const Eigen::MatrixXd*> columns_;
  std::shared_ptr<const ContactSystem> system_;
};

}  // namespace

const Eigen::MatrixXd& PreconditionerColumns::of(const Preconditioner& preconditioner, std::uint32_t control_point,
                                                 Eigen::Index control_point_count) {
  const auto found = columns_.find(control_point);
  if (found != columns_.end()) return found->second;
  Eigen::MatrixXd columns(3 * control_point_count, 3);
  Eigen::Matrix3Xd unit = Eigen::Matrix3Xd::Zero(3, control_point_count), answer;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    unit.col(control_point) = Eigen::Vector3d::Unit(axis);
    preconditioner.apply(unit, answer);
    columns.col(axis) = Eigen::Map<const Eigen::VectorXd>(answer.data(), answer.size());
  }
  return columns_.emplace(control_point, std::move(columns)).first->second;
}

std::unique_ptr<Preconditioner> with_contact(const Preconditioner& preconditioner, PreconditionerColumns& columns,
                                             const ContactStep& contact, Eigen::Index control_point_count) {
  std::vector<std::uint32_t> touched = contact.touched_control_points();
  const double bytes = 72.0 * static_cast<double>(control_point_count) * static_cast<double>(touched.size());
  if (touched.empty() || touched.size() > k_most_control_points || bytes > k_most_bytes) return nullptr;
  return std::make_unique<WithContact>(preconditioner, columns, contact, std::move(touched), control_point_count);
}

}  // namespace argil::fem
