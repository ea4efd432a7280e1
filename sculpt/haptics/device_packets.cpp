#include "sculpt/haptics/device_packets.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

namespace argil::sculpt {

namespace {

constexpr std::uint32_t k_magic = 0x44475241;  // "ARGD"
constexpr std::uint16_t k_sample = 1, k_model = 2;
constexpr std::uint32_t k_longest_life = 1000;

class Writer {
 public:
  explicit Writer(PacketBytes& bytes) : bytes_(bytes) {}
  template <class Unsigned>
  void number(Unsigned value) {
    for (std::size_t i = 0; i < sizeof value; ++i)
      bytes_[size_++] = static_cast<std::byte>((value >> (8 * i)) & 0xff);
  }
  void real(double value) { number(std::bit_cast<std::uint64_t>(value)); }
  void vector(const Eigen::Vector3d& v) {
    for (int i = 0; i < 3; ++i) real(v[i]);
  }
  std::size_t size() const { return size_; }

 private:
  PacketBytes& bytes_;
  std::size_t size_ = 0;
};

class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}
  template <class Unsigned>
  Unsigned number() {
    Unsigned value = 0;
    if (bytes_.size() < sizeof value) {
      good_ = false;
      return value;
    }
    for (std::size_t i = 0; i < sizeof value; ++i)
      value = static_cast<Unsigned>(value | static_cast<Unsigned>(std::to_integer<Unsigned>(bytes_[i])) << (8 * i));
    bytes_ = bytes_.subspan(sizeof value);
    return value;
  }
  double real() {
    const double value = std::bit_cast<double>(number<std::uint64_t>());
    good_ = good_ && std::isfinite(value);
    return value;
  }
  Eigen::Vector3d vector() {
    Eigen::Vector3d v;
    for (int i = 0; i < 3; ++i) v[i] = real();
    return v;
  }
  void require(bool condition) { good_ = good_ && condition; }
  bool good() const { return good_; }
  bool whole() const { return good_ && bytes_.empty(); }

 private:
  std::span<const std::byte> bytes_;
  bool good_ = true;
};

bool near_one(double size) {
  return std::abs(size - 1) < 1e-6;
}

SamplePacket read_sample(Reader& in) {
  SamplePacket packet;
  DeviceSample& sample = packet.sample;
  sample.tick = static_cast<Tick>(in.number<std::uint64_t>());
  const auto mode = in.number<std::uint32_t>();
  in.require(mode <= static_cast<std::uint32_t>(DeviceMode::fault));
  if (in.good()) sample.mode = static_cast<DeviceMode>(mode);
  sample.buttons = in.number<std::uint32_t>();
  sample.pose.position = in.vector();
  for (int i = 0; i < 4; ++i) sample.pose.orientation.coeffs()[i] = in.real();
  if (in.good()) in.require(near_one(sample.pose.orientation.coeffs().stableNorm()));
  packet.force = in.vector();
  return packet;
}

ModelPacket read_model(Reader& in) {
  ModelPacket packet;
  ContactModel& model = packet.model;
  packet.answers = static_cast<Tick>(in.number<std::uint64_t>());
  const auto life = in.number<std::uint32_t>(), planes = in.number<std::uint32_t>();
  in.require(life <= k_longest_life && planes <= ContactModel::k_max_planes);
  model.valid_until = life;
  model.plane_count = in.good() ? planes : 0;
  model.point = in.vector();
  model.force = in.vector();
  for (int row = 0; row < 3; ++row) model.derivative.row(row) = in.vector().transpose();
  for (std::size_t i = 0; i < model.plane_count; ++i) {
    ContactPlane& plane = model.planes[i];
    plane.normal = in.vector();
    plane.offset = in.real();
    plane.stiffness = in.real();
    if (in.good()) in.require(near_one(plane.normal.stableNorm()) && plane.stiffness >= 0);
  }
  return packet;
}

}  // namespace

std::size_t write_packet(const Packet& packet, PacketBytes& bytes) {
  Writer out(bytes);
  out.number(k_magic);
  out.number(k_packet_version);
  out.number(std::holds_alternative<SamplePacket>(packet.body) ? k_sample : k_model);
  out.number(packet.session);
  out.number(packet.sequence);
  if (const auto* body = std::get_if<SamplePacket>(&packet.body)) {
    out.number(static_cast<std::uint64_t>(body->sample.tick));
    out.number(static_cast<std::uint32_t>(body->sample.mode));
    out.number(body->sample.buttons);
    out.vector(body->sample.pose.position);
    for (int i = 0; i < 4; ++i) out.real(body->sample.pose.orientation.coeffs()[i]);
    out.vector(body->force);
    return out.size();
  }
  const auto& [answers, model] = std::get<ModelPacket>(packet.body);
  assert(model.plane_count <= ContactModel::k_max_planes);
  out.number(static_cast<std::uint64_t>(answers));
  out.number(static_cast<std::uint32_t>(std::clamp<Tick>(model.valid_until, 0, k_longest_life)));
  out.number(static_cast<std::uint32_t>(model.plane_count));
  out.vector(model.point);
  out.vector(model.force);
  for (int row = 0; row < 3; ++row) out.vector(model.derivative.row(row).transpose());
  for (std::size_t i = 0; i < model.plane_count; ++i) {
    out.vector(model.planes[i].normal);
    out.real(model.planes[i].offset);
    out.real(model.planes[i].stiffness);
  }
  return out.size();
}

std::optional<Packet> read_packet(std::span<const std::byte> bytes) {
  Reader in(bytes);
  if (in.number<std::uint32_t>() != k_magic || in.number<std::uint16_t>() != k_packet_version) return std::nullopt;
  const auto kind = in.number<std::uint16_t>();
  Packet packet;
  packet.session = in.number<std::uint64_t>();
  packet.sequence = in.number<std::uint64_t>();
  if (kind == k_sample)
    packet.body = read_sample(in);
  else if (kind == k_model)
    packet.body = read_model(in);
  else
    return std::nullopt;
  if (!in.whole()) return std::nullopt;
  return packet;
}

}  // namespace argil::sculpt
