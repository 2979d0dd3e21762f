// A new drilling: a text to begin with, which is no file before it is saved.

export const BEGIN = `# A hole through a plate: change the surfaces, the point and the numbers.
title = "Drilling"

[tool]
number = 1
type = "drill"
diameter = 10
point = { twist = { point_angle = 118 } }
flute_length = 120

[operation]
type = "drill"
tool = 1
entry = { surface = "plane" }
exit = { surface = "plane" }
length = 40
approach = 2
overrun = 2
cutting_speed = 25
feed_per_rev = { entry = 0.1, steady = 0.2, exit = 0.1 }
`;
