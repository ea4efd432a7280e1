// Pens: what drivers say of them, decoded; and a pen on an X server, by the server's own driver for tests, where
// there is that (tools/setup --pens).

#include "tools/devices/pen.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <sstream>
#include <thread>

#include "subdiv/error.h"
#include "tests/tools/pen_server.h"
#include "tools/devices/device_table.h"

namespace argil::devices {
namespace {

PointingDevice stylus(int id = 6, const std::string& name = "Tablet Pen stylus",
                      const std::string& type = "STYLUS") {
  return {id, name, type, {{0, "Abs X", 0, 44704}, {1, "Abs Y", 0, 27940}, {2, "Abs Pressure", 100, 2148}}};
}

const PointingDevice k_mouse{9, "Mouse", "MOUSE", {{0, "Rel X", -1, -1}, {1, "Rel Y", -1, -1}}};

double pressure_of(PenDecoder& decoder, int device, double value) {
  const ValuatorNow now{2, value};
  decoder.take(device, {&now, 1});
  return decoder.state().pressure;
}

TEST(Pen, PressureIsTheShareOfTheRangeThatTheDriverGives) {
  PenDecoder decoder;
  const PointingDevice pen = stylus();
  decoder.set_devices({&pen, 1});
  EXPECT_TRUE(decoder.state().plugged);
  EXPECT_EQ(decoder.state().pressure, 1) << "nothing has moved yet";
  EXPECT_EQ(pressure_of(decoder, 6, 100), 0);
  EXPECT_EQ(pressure_of(decoder, 6, 100 + 512), 0.25);
  EXPECT_EQ(pressure_of(decoder, 6, 2148), 1);
  EXPECT_EQ(pressure_of(decoder, 6, 99), 0);
  EXPECT_EQ(pressure_of(decoder, 6, 1e9), 1);
  EXPECT_EQ(pressure_of(decoder, 6, std::nan("")), 1);
  EXPECT_EQ(pressure_of(decoder, 6, -std::numeric_limits<double>::infinity()), 1);
  EXPECT_FALSE(decoder.state().eraser);
  // Drivers say only what has changed.
  EXPECT_EQ(pressure_of(decoder, 6, 100 + 1024), 0.5);
  const ValuatorNow moved{0, 77};
  decoder.take(6, {&moved, 1});
  EXPECT_EQ(decoder.state().pressure, 0.5);
}

TEST(Pen, TheLabelTellsPressureWhereverItIs) {
  PointingDevice device = stylus();
  device.valuators = {{3, "Abs Tilt X", -64, 63}, {5, "Abs Pressure", 0, 65535}, {6, "Abs MT Pressure", 0, 255}};
  const auto pen = pen_of(device);
  ASSERT_TRUE(pen);
  EXPECT_EQ(pen->valuator, 5);
  EXPECT_EQ(pen->high, 65535);
  device.valuators = {{6, "Abs MT Pressure", 0, 255}, {7, "Pressure", 0, 255}};
  EXPECT_FALSE(pen_of(device));
  device.valuators = {{2, "Abs Pressure", -1, -1}};
  EXPECT_FALSE(pen_of(device)) << "a range of nothing";
  EXPECT_FALSE(pen_of(k_mouse));
  EXPECT_FALSE(pen_of(stylus(6, "SynPS/2 Synaptics TouchPad", "")));
}

TEST(Pen, TheEraserIsToldByNameOrType) {
  EXPECT_FALSE(pen_of(stylus())->eraser);
  EXPECT_TRUE(pen_of(stylus(7, "Wacom Intuos Pro M Pen eraser"))->eraser);
  EXPECT_TRUE(pen_of(stylus(7, "Wacom Pen Eraser (0x8)", ""))->eraser);
  EXPECT_TRUE(pen_of(stylus(7, "Tablet", "ERASER"))->eraser);
  PenDecoder decoder;
  const std::vector<PointingDevice> both{stylus(6), stylus(7, "Tablet Pen eraser")};
  decoder.set_devices(both);
  EXPECT_EQ(pressure_of(decoder, 7, 1124), 0.5);
  EXPECT_TRUE(decoder.state().eraser);
  EXPECT_EQ(pressure_of(decoder, 6, 612), 0.25);
  EXPECT_FALSE(decoder.state().eraser);
}

TEST(Pen, WhatMovedLastIsInTheHand) {
  PenDecoder decoder;
  std::vector<PointingDevice> devices{stylus(), k_mouse};
  decoder.set_devices(devices);
  EXPECT_EQ(pressure_of(decoder, 6, 612), 0.25);
  const ValuatorNow moved{0, 1};
  decoder.take(9, {&moved, 1});
  EXPECT_EQ(decoder.state().pressure, 1);
  decoder.take(6, {});
  EXPECT_EQ(decoder.state().pressure, 0.25);
  // Something is plugged in beside it; then it goes itself, and comes back as another device with another range.
  devices.push_back(stylus(11, "Second pen"));
  decoder.set_devices(devices);
  EXPECT_EQ(decoder.state().pressure, 0.25);
  devices = {k_mouse};
  decoder.set_devices(devices);
  EXPECT_FALSE(decoder.state().plugged);
  EXPECT_EQ(decoder.state().pressure, 1);
  EXPECT_EQ(pressure_of(decoder, 6, 2000), 1) << "what it still said";
  devices.push_back(stylus(12));
  devices.back().valuators[2] = {4, "Abs Pressure", 0, 8191};
  decoder.set_devices(devices);
  const ValuatorNow now{4, 8191.0 / 4};
  decoder.take(12, {&now, 1});
  EXPECT_EQ(decoder.state().pressure, 0.25);
  // The same device with another range: as when another pen comes near the tablet.
  devices.back().valuators[2].high = 4096;
  decoder.set_devices(devices);
  const ValuatorNow then{4, 1024};
  decoder.take(12, {&then, 1});
  EXPECT_EQ(decoder.state().pressure, 0.25);
}

TEST(Pen, ItGoesWithTheMouse) {
  try {
    (void)open_device("pen");
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("goes with the mouse"), std::string::npos);
  }
}

TEST(Pen, WithoutADisplayThereIsNoneAndItSaysWhy) {
  const tests::OtherDisplay none("");
  EXPECT_EQ(open_pens(), nullptr);
  const PensFound found = find_pens();
  EXPECT_FALSE(found.present);
  EXPECT_NE(found.state.find(pens_supported() ? "DISPLAY" : "libxi-dev"), std::string::npos) << found.state;
  for (const DeviceEntry& entry : list_devices())
    if (entry.name == "pen") {
      EXPECT_TRUE(entry.capabilities.senses_pressure);
      EXPECT_FALSE(entry.present || entry.opens);
    }
}

// What the display said comes within a moment.
bool comes(const std::function<bool()>& condition) {
  for (int i = 0; i < 500 && !condition(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return condition();
}

TEST(PenSlow, APenOfAnXServerIsHeard) {
  if (!pens_supported()) GTEST_SKIP() << "this build has no XInput";
  tests::PenServer server;
  if (!server.runs()) GTEST_SKIP() << server.reason();
  const tests::OtherDisplay display(server.display());
  const PensFound found = find_pens();
  EXPECT_TRUE(found.present);
  EXPECT_EQ(found.state, "pen, pen eraser (inverts)");

  const std::unique_ptr<PenReader> reader = open_pens();
  ASSERT_TRUE(reader);
  EXPECT_TRUE(comes([&] { return reader->state().plugged; }));
  EXPECT_EQ(reader->state().pressure, 1);
  server.pen().move(20000, 20000, 250);
  EXPECT_TRUE(comes([&] { return reader->state().pressure == 0.25; })) << reader->state().pressure;
  server.pen().button(1, true);
  server.pen().move(20100, 20000, 750);
  EXPECT_TRUE(comes([&] { return reader->state().pressure == 0.75; })) << reader->state().pressure;
  server.pen().button(1, false);
  server.eraser().move(30000, 20000, 500);
  EXPECT_TRUE(comes([&] { return reader->state().eraser && reader->state().pressure == 0.5; }));
  server.mouse().move_by(5, 5);
  EXPECT_TRUE(comes([&] { return !reader->state().eraser && reader->state().pressure == 1; }));
  EXPECT_TRUE(reader->state().plugged);
  // Plugged out and in again.
  server.enable("pen", false);
  server.enable("pen eraser", false);
  EXPECT_TRUE(comes([&] { return !reader->state().plugged; }));
  server.enable("pen", true);
  EXPECT_TRUE(comes([&] { return reader->state().plugged; }));
  EXPECT_EQ(reader->state().pressure, 1) << "the mouse still has it";
  // A display that goes away takes the pens with it, and nothing else.
  server.pen().move(20000, 20000, 250);
  EXPECT_TRUE(comes([&] { return reader->state().pressure == 0.25; }));
  server.stop();
  EXPECT_TRUE(comes([&] { return !reader->state().plugged; }));
  EXPECT_EQ(reader->state().pressure, 1);
}

// A stroke from a light touch to a firm one, upwards from the middle of the block.
void draw(tests::PenServer& server) {
  const auto pause = [] { std::this_thread::sleep_for(std::chrono::milliseconds(40)); };
  const auto move = [&](int up, double pressure) {
    server.pen().move(600 / 1440.0 * 65536, (330 - up) / 900.0 * 65536, pressure);
    pause();
  };
  for (int i = 0; i < 5; ++i) move(i % 2, 0);
  server.pen().button(1, true);
  for (int i = 0; i < 5; ++i) move(i % 2, 200);
  for (int i = 0; i <= 15; ++i) move(5 * i, 200 + 40 * i);
  for (int i = 0; i <= 15; ++i) move(75 + i % 2, 800);  // frames may be slow
  server.pen().button(1, false);
  pause();
}

TEST(PenSlow, AStrokeOfAPenInTheWindowIsJournaledWithItsPressure) {
  if (!pens_supported()) GTEST_SKIP() << "this build has no XInput";
  tests::PenServer server;
  if (!server.runs()) GTEST_SKIP() << server.reason();
  const tests::OtherDisplay display(server.display());
  const tests::TemporaryFolder folder;
  const std::filesystem::path journal = folder / "out/journal.argil";
  const auto lines = [&](const std::string& beginning) {
    std::vector<std::string> all;
    std::istringstream text(std::filesystem::is_regular_file(journal) ? tests::read_bytes(journal) : "");
    for (std::string each; std::getline(text, each);)
      if (each.starts_with(beginning)) all.push_back(each);
    return all;
  };
  // A stroke with less than a third of the pressure in it, and more than three fifths.
  const auto rises = [](const std::string& stroke) {
    const std::size_t at = stroke.find(" pressures");
    std::istringstream numbers(at == stroke.npos ? "" : stroke.substr(at + 10));
    double lowest = 1, highest = 0;
    for (double pressure = 0; numbers >> pressure;) {
      lowest = std::min(lowest, pressure);
      highest = std::max(highest, pressure);
    }
    EXPECT_LE(highest, 0.8) << stroke;  // as hard as it was pressed
    return lowest < 0.3 && highest > 0.6;
  };
  const auto drawn = [&] {
    const std::vector<std::string> strokes = lines("stroke path");
    return std::any_of(strokes.begin(), strokes.end(), rises);
  };
  tests::Finished window;
  std::thread runs([&] { window = tests::run_argil({"studio", "--out", "out"}, folder.path()); });
  EXPECT_TRUE(comes([&] { return !lines("tool pull").empty(); }));
  // The window may not be ready for the first ones, or slow.
  for (int i = 0; i < 8 && !drawn(); ++i) {
    draw(server);
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
  }
  server.stop();  // and with it goes the window
  runs.join();
  EXPECT_EQ(window.status, 1) << window.err;
  EXPECT_TRUE(drawn()) << window.err;
  const tests::Finished replayed =
      tests::run_argil({"replay", "out/journal.argil", "--out", "replayed"}, folder.path());
  EXPECT_EQ(replayed.status, 0) << replayed.err;
}

}  // namespace
}  // namespace argil::devices
