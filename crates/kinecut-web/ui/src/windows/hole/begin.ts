// A new hole: the worked example of Sorokin, But and Kombarov 2013, for a control that takes the base radius as it is.

export const BEGIN = `# The worked example of Sorokin, But, Kombarov 2013: roughing from the centre, finishing from T0 = (-40, 40).
title = "Bore 200"

[tool]
number = 1
type = "end-mill"
diameter = 40
flute_length = 45
teeth = 4
centre_cutting = true
max_ramp_angle = 5

[operation]
type = "bore"
tool = 1
at = [0, 0]
diameter = 200
depth = 30
strategy = "involute"
entry = "plunge"
speed = 2400
rough = { stepover = 4, allowance = 1, feed = 6000 }
finish = { turns = 2, feed = 3000, start = [-40, 40] }

[post]
control = "heidenhain"

[dynamics]
rapid = 60000
acceleration = 5
jerk = 100
`;
