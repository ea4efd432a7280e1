#include "sculpt/haptics/network_device.h"

namespace argil::sculpt {

namespace {

// A flood of packets must not hold a tick up; what is left waits for the next one.
constexpr int k_most_a_tick = 64;

template <class Body, class Take>
void take_newest(DatagramLink& link, PacketOrder& order, Tick now, const Take& take) {
  PacketBytes bytes;
  for (int i = 0; i < k_most_a_tick; ++i) {
    const std::optional<std::size_t> size = link.receive(bytes);
    if (!size) return;
    const std::optional<Packet> packet = read_packet(std::span(bytes).first(*size));
    if (!packet) continue;
    if (const Body* body = std::get_if<Body>(&packet->body); body != nullptr && order.accept(*packet, now))
      take(*body);
  }
}

}  // namespace

bool PacketOrder::accept(const Packet& packet, Tick now) {
  if (heard_ && packet.session != session_) {
    if (now - last_ < k_run_is_over) return false;
    heard_ = false;
  }
  if (heard_ && packet.sequence <= sequence_) return false;
  if (heard_) lost_ += packet.sequence - sequence_ - 1;
  heard_ = true;
  session_ = packet.session;
  sequence_ = packet.sequence;
  last_ = now;
  return true;
}

NetworkDevice::NetworkDevice(DatagramLink& link, std::uint64_t session, Tick patience)
    : link_(link), session_(session), patience_(patience) {}

DeviceCapabilities NetworkDevice::capabilities() const {
  DeviceCapabilities capabilities;
  capabilities.actuated_axes = 3;
  capabilities.max_force = SafetyLimits{}.max_force;
  return capabilities;
}

void NetworkDevice::publish(const ContactModel& model, Tick now) {
  Packet packet{session_, ++sequence_, ModelPacket{answers_, model}};
  std::get<ModelPacket>(packet.body).model.valid_until = model.valid_until - now;
  PacketBytes bytes;
  link_.send(std::span<const std::byte>(bytes).first(write_packet(packet, bytes)));
}

DeviceSample NetworkDevice::exchange(const ForceCommand&, Tick tick) {
  take_newest<SamplePacket>(link_, order_, tick, [&](const SamplePacket& packet) {
    answers_ = packet.sample.tick;
    sample_ = packet.sample;
    sample_.tick = tick;
    force_ = packet.force;
  });
  DeviceSample sample = sample_;
  if (!order_.heard() || order_.silent_since(tick) > patience_) {
    sample.mode = DeviceMode::closed;
    if (!order_.heard()) sample.tick = tick;
  }
  return sample;
}

DeviceHost::DeviceHost(Device& device, DatagramLink& link, std::uint64_t session, const ServoOptions& options)
    : link_(link), session_(session), servo_(device, channel_, options) {}

ServoTick DeviceHost::tick(Tick now) {
  take_newest<ModelPacket>(link_, order_, now, [&](const ModelPacket& packet) {
    if (packet.answers > now || now - packet.answers > k_oldest_answer) return;
    ContactModel model = packet.model;
    model.valid_until += now;
    channel_.publish(model);
  });
  const ServoTick tick = servo_.tick(now);
  const Packet packet{session_, ++sequence_, SamplePacket{tick.sample, tick.safety.force}};
  PacketBytes bytes;
  link_.send(std::span<const std::byte>(bytes).first(write_packet(packet, bytes)));
  return tick;
}

}  // namespace argil::sculpt
