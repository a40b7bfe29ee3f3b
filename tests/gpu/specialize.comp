// The same work twice: by numbers that specialization constants give (kIsKnown = 1), and by the same numbers from memory.
#version 460
layout(local_size_x = 1) in;
layout(constant_id = 0) const uint kIsKnown = 0u;
layout(constant_id = 1) const uint kPiece = 0u;
layout(constant_id = 2) const uint kFirst = 0u;
layout(constant_id = 3) const uint kSecond = 0u;
layout(constant_id = 4) const bool kSwitched = false;
layout(constant_id = 5) const float kScale = 1.0;

layout(set = 0, binding = 0, std430) readonly buffer In { uint piece, first, second, switched; float scale; float list[]; } given;
layout(set = 0, binding = 1, std430) writeonly buffer Out { uint values[]; } result;

uint piece() { return kIsKnown != 0u ? kPiece : given.piece; }
uint first() { return kIsKnown != 0u ? kFirst : given.first; }
uint second() { return kIsKnown != 0u ? kSecond : given.second; }
bool switched() { return kIsKnown != 0u ? kSwitched : given.switched != 0u; }
float scale() { return kIsKnown != 0u ? kScale : given.scale; }

void operations() {
  const uint a = first(), b = second();
  const int s = int(a), t = int(b);
  const uint results[] = uint[](
    a + b, a - b, a * b, ~a, uint(-s), a | b, a & b, a ^ b,
    a >> (b & 31u), a << (b & 31u), uint(s >> (t & 31)),
    uint(a == b), uint(a != b), uint(a < b), uint(a <= b), uint(a > b), uint(a >= b),
    uint(s < t), uint(s <= t), uint(s > t), uint(s >= t),
    uint(switched() && a > b), uint(switched() || a > b), uint(!switched()), uint(switched() == (a > b)),
    uint(switched() != (a > b)), switched() ? a : b);
  for (int i = 0; i < results.length(); ++i) result.values[i] = results[i];
  if (b == 0u || (a == 0x80000000u && t == -1)) return;
  result.values[32] = a / b;
  result.values[33] = a % b;
  result.values[34] = uint(s / t);
  if (s >= 0 && t >= 0) result.values[35] = uint(s % t);
}

// Breaks, continues and returns out of nested control flow.
float walk(float start) {
  float sum = start;
  for (uint i = 0u; i < second(); ++i) {
    if (i == 3u && switched()) continue;
    switch (first()) {
    case 0u:
      sum += given.list[i];
      break;
    case 1u:
      if (given.list[i] > 0.5) break;
      sum *= scale();
      if (switched()) return sum;
    case 2u: // from above, too
      sum -= given.list[i];
      break;
    default:
      if (i > first()) return -sum;
      sum += 0.25;
    }
    if (sum > 8.0) break;
  }
  return sum * scale();
}

float countDown() {
  float product = 1.0;
  uint left = second();
  do {
    product *= given.list[left & 7u] + scale();
    if (switched() && left < first()) break;
    --left;
  } while (left < 8u && left > 0u);
  return product;
}

// A loop that leaves in its first turn, and one that has none.
float once() {
  float value = scale();
  for (;;) {
    value += given.list[0];
    if (switched()) {
      value *= 2.0;
      break;
    }
    break;
  }
  for (uint i = 0u; i < first(); ++i) {
    if (second() >= 0u) break;
    value += 100.0;
  }
  for (;;) { // both ways leave it
    if (given.list[1] > scale()) {
      value += 3.0;
      break;
    } else {
      value -= switched() ? 3.0 : 5.0;
      break;
    }
  }
  while (switched() && value < 0.0) value += float(second());
  return value;
}

struct Pair { float a; uint b[3]; };
// Stores into parts of variables, of which some are never read.
float store() {
  Pair pair, unread;
  pair.a = given.list[1];
  pair.b = uint[](first(), second(), 7u);
  unread.a = sqrt(given.list[2]);
  unread.b[first() % 3u] = second();
  if (switched()) pair.b[second() % 3u] = first() + 1u;
  if (first() == 2u) unread = pair;
  float whole;
  modf(4.0 * pair.a + scale(), whole); // for what it writes
  const float chosen = mix(given.list[3], given.list[4], switched());
  return pair.a * float(pair.b[0] + 2u * pair.b[1] + 4u * pair.b[2]) + whole + chosen;
}

// Called where the numbers come from memory alone.
float slowly(float value) {
  for (int i = 0; i < 3; ++i) value = sqrt(value + given.list[i + 4]);
  return value;
}

void raise(inout float value, out uint count) {
  count = second() + 1u;
  if (switched()) return;
  value *= scale();
  count += first();
}

// Phis of several types where no turn comes: the loop around them stays.
float turns() {
  vec3 sum = vec3(given.list[0], 1.0, 2.0);
  bool isOdd = false;
  float value = 0.0;
  for (uint k = 0u; k < 2u + (given.piece & 1u); ++k) {
    for (uint i = 0u; i < first(); ++i) {
      sum = sum.yzx * scale();
      isOdd = !isOdd;
      value += sum.x;
      if (value > 4.0) break;
    }
    switch (second()) {
    case 1u:
      continue;
    default:
      value += isOdd ? 0.5 : 0.25;
    }
  }
  return value + sum.x + sum.z * 0.5;
}

float call() {
  float value = given.list[2];
  uint count;
  raise(value, count);
  return value * float(count);
}

void main() {
  if (kIsKnown == 0u && given.piece == 9u) result.values[1] = floatBitsToUint(slowly(given.scale));
  switch (piece()) {
  case 0u:
    operations();
    break;
  case 1u:
    result.values[0] = floatBitsToUint(walk(given.list[7]));
    break;
  case 2u:
    result.values[0] = floatBitsToUint(countDown());
    break;
  case 3u:
    result.values[0] = floatBitsToUint(once());
    break;
  case 4u:
    result.values[0] = floatBitsToUint(store());
    break;
  case 5u:
    result.values[0] = floatBitsToUint(turns());
    break;
  case 6u:
    result.values[0] = floatBitsToUint(call());
  }
}
