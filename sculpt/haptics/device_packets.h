#pragma once
// What a device's host and the program say to each other, one datagram a message, little-endian, version in the
// head: samples towards the program, contact models towards the device. Forces do not cross the network: the servo
// runs beside the device, so that delay and loss make its picture of the world old, but never its force unstable.
//
//   "ARGD" | version u16 | kind u16 | session u64 | sequence u64 | body
//   sample (1): tick i64, mode u32, buttons u32, position 3 f64 [m], orientation x y z w f64, force 3 f64 [N]
//               (no pressure: what comes by the network is pressed with 1)
//   model  (2): tick of the sample that it answers i64, life u32 [ticks], planes u32, point 3 f64, force 3 f64,
//               derivative 9 f64 by rows, then for each plane normal 3 f64, offset f64, stiffness f64

#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "sculpt/haptics/contact_model.h"

namespace argil::sculpt {

inline constexpr std::uint16_t k_packet_version = 1;

struct SamplePacket {
  DeviceSample sample;                              // tick by the host's clock
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  // that the device applies [N]
};

struct ModelPacket {
  Tick answers = 0;    // tick of the newest sample that the simulation had seen
  ContactModel model;  // valid_until counts from the packet's arrival
};

struct Packet {
  std::uint64_t session = 0;   // of the sender's run, so that a restart is told from an old packet
  std::uint64_t sequence = 0;  // rises
  std::variant<SamplePacket, ModelPacket> body;
};

using PacketBytes = std::array<std::byte, 1200>;

/// @returns how many bytes of `bytes` were written. Neither allocates nor throws.
std::size_t write_packet(const Packet& packet, PacketBytes& bytes);

/// Nothing for what is not a whole packet of this version with finite numbers, unit normals and quaternions,
/// stiffnesses ≥ 0, at most ContactModel::k_max_planes planes and lives of at most 1000 ticks.
[[nodiscard]] std::optional<Packet> read_packet(std::span<const std::byte> bytes);

}  // namespace argil::sculpt
